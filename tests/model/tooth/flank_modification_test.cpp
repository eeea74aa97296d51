// Where each key removes material, and what is refused.

#include "strainwave/model/tooth/flank_modification.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

constexpr double face = 6.0;

double um(const FlankModification& m, Member member, double h, double zeta = 0.0) {
  return 1e3 * removal_mm(m, member, h, zeta, face);
}
double on_tooth(const FlankModification& m, double h, double zeta = 0.0) {
  return um(m, Member::flexspline, h, zeta);
}
double on_space(const FlankModification& m, double h, double zeta = 0.0) {
  return um(m, Member::circular_spline, h, zeta);
}

TEST(FlankModification, NothingByDefault) {
  for (double h = 0.0; h <= 1.0; h += 0.25)
    EXPECT_EQ(on_tooth({}, h, 0.9), 0.0);
}

TEST(FlankModification, TipReliefGrowsFromItsStartToTheMembersTip) {
  FlankModification m;
  m.tip_relief_um = 8.0;
  m.tip_relief_start = 0.6;
  m.tip_relief_power = 3.0;
  EXPECT_EQ(on_tooth(m, 0.6), 0.0);
  EXPECT_NEAR(on_tooth(m, 0.8), 1.0, 1e-13); // (1/2)^3 of 8
  EXPECT_NEAR(on_tooth(m, 1.0), 8.0, 1e-13);
  // The circular spline's tip is at h = 0; the start counts from its root as well.
  EXPECT_EQ(on_space(m, 0.4), 0.0);
  EXPECT_NEAR(on_space(m, 0.2), 1.0, 1e-13);
  EXPECT_NEAR(on_space(m, 0.0), 8.0, 1e-13);
}

TEST(FlankModification, RootReliefIsStraightTowardsTheMembersRoot) {
  FlankModification m;
  m.root_relief_um = 6.0;
  m.root_relief_start = 0.4;
  EXPECT_EQ(on_tooth(m, 0.4), 0.0);
  EXPECT_NEAR(on_tooth(m, 0.2), 3.0, 1e-13);
  EXPECT_NEAR(on_tooth(m, 0.0), 6.0, 1e-13);
  EXPECT_NEAR(on_space(m, 0.8), 3.0, 1e-13);
  EXPECT_NEAR(on_space(m, 1.0), 6.0, 1e-13);
}

TEST(FlankModification, CrowningLeavesTheMiddle) {
  FlankModification m;
  m.crowning_um = 4.0;
  EXPECT_EQ(on_tooth(m, 0.5), 0.0);
  EXPECT_NEAR(on_tooth(m, 0.0), 4.0, 1e-13);
  EXPECT_NEAR(on_tooth(m, 1.0), 4.0, 1e-13);
  EXPECT_NEAR(on_tooth(m, 0.75), 1.0, 1e-13);
}

TEST(FlankModification, SlopeRemovesTowardsOneWhenPositiveAndTowardsZeroWhenNegative) {
  FlankModification m;
  m.slope_um = 5.0;
  EXPECT_EQ(on_tooth(m, 0.0), 0.0);
  EXPECT_NEAR(on_tooth(m, 1.0), 5.0, 1e-13);
  EXPECT_NEAR(on_space(m, 1.0), 5.0, 1e-13);
  m.slope_um = -5.0;
  EXPECT_NEAR(on_tooth(m, 0.0), 5.0, 1e-13);
  EXPECT_EQ(on_tooth(m, 1.0), 0.0);
}

TEST(FlankModification, SplineGoesThroughItsValuesAndIsNaturalAtItsEnds) {
  FlankModification m;
  m.spline_um = {1.0, 4.0, 2.0, 3.0, 0.5};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(on_tooth(m, 0.25 * static_cast<double>(k)), m.spline_um[k], 1e-13);
    EXPECT_NEAR(on_space(m, 0.25 * static_cast<double>(k)), m.spline_um[k], 1e-13);
  }
  const auto second = [&](double h, double d) {
    return (on_tooth(m, h - d) - 2.0 * on_tooth(m, h) + on_tooth(m, h + d)) / (d * d);
  };
  // In the first interval u'' is linear and zero at h = 0.
  EXPECT_NEAR(second(0.02, 0.01) / second(0.04, 0.01), 0.5, 1e-6);
  // u'' is continuous across a knot.
  EXPECT_NEAR(second(0.5 - 2e-3, 1e-3), second(0.5 + 2e-3, 1e-3), 1.5);
  m.spline_um = {2.0};
  EXPECT_NEAR(on_tooth(m, 0.3), 2.0, 1e-13);
  m.spline_um = {1.0, 3.0};
  EXPECT_NEAR(on_tooth(m, 0.3), 1.6, 1e-13);
}

TEST(FlankModification, NaturalSplineOfThreeKnotsAgreesWithItsClosedForm) {
  // Values 0, 1, 0 at 0, 1/2, 1: s(h) = 3 h - 4 h^3 on the first half.
  FlankModification m;
  m.spline_um = {0.0, 1.0, 0.0};
  for (double h = 0.0; h <= 0.5; h += 0.1)
    EXPECT_NEAR(on_tooth(m, h), 3.0 * h - 4.0 * h * h * h, 1e-13);
}

TEST(FlankModification, LeadKeysActAcrossTheFace) {
  FlankModification m;
  m.lead_crowning_um = 3.0;
  EXPECT_EQ(on_tooth(m, 0.5, 0.0), 0.0);
  EXPECT_NEAR(on_tooth(m, 0.5, -1.0), 3.0, 1e-13);
  EXPECT_NEAR(on_tooth(m, 0.5, 0.5), 0.75, 1e-13);
  m = {};
  m.lead_taper_um = 4.0; // towards the open end
  EXPECT_NEAR(on_tooth(m, 0.5, 1.0), 4.0, 1e-13);
  EXPECT_NEAR(on_tooth(m, 0.5, -1.0), 0.0, 1e-13);
  m.lead_taper_um = -4.0;
  EXPECT_NEAR(on_tooth(m, 0.5, -1.0), 4.0, 1e-13);
  m = {};
  m.end_relief_um = 8.0;
  m.end_relief_length_mm = 1.5; // a quarter of the face
  EXPECT_NEAR(on_tooth(m, 0.5, 0.5), 0.0, 1e-13);
  EXPECT_NEAR(on_tooth(m, 0.5, 0.75), 2.0, 1e-13);
  EXPECT_NEAR(on_tooth(m, 0.5, 1.0), 8.0, 1e-13);
  EXPECT_NEAR(on_tooth(m, 0.5, -1.0), 8.0, 1e-13);
}

TEST(FlankModification, AddedMaterialIsRefusedWithThePlace) {
  FlankModification m;
  m.spline_um = {1.0, -0.5, 1.0};
  const auto failure = find_added_material(m, Member::flexspline, face);
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->status, Status::contradiction);
  EXPECT_NE(failure->message.find("-0.5000 um at flank coordinate 0.500"), std::string::npos)
      << failure->message;
  // Between the knots of a spline too: this one is positive at its knots and dips below zero beside them.
  m.spline_um = {0.0, 0.0, 10.0, 0.0, 0.0};
  EXPECT_TRUE(find_added_material(m, Member::flexspline, face).has_value());
  // Another key may make up for it.
  m.crowning_um = 40.0;
  m.root_relief_um = 0.0;
  m.spline_um = {-10.0, 0.0, 0.0, 0.0, -10.0};
  EXPECT_FALSE(find_added_material(m, Member::flexspline, face).has_value());
  m = {};
  m.slope_um = -5.0;
  m.lead_taper_um = -2.0;
  EXPECT_FALSE(find_added_material(m, Member::circular_spline, face).has_value());
  m.lead_crowning_um = -3.0;
  EXPECT_TRUE(find_added_material(m, Member::circular_spline, face).has_value());
}

TEST(FlankModification, NumbersWithoutMeaningAreRefused) {
  FlankModification m;
  m.tip_relief_um = 1.0;
  m.tip_relief_power = 0.5;
  EXPECT_TRUE(find_added_material(m, Member::flexspline, face).has_value());
  m.tip_relief_power = 2.0;
  m.tip_relief_start = 1.0;
  EXPECT_TRUE(find_added_material(m, Member::flexspline, face).has_value());
  m = {};
  m.root_relief_um = 1.0;
  m.root_relief_start = 0.0;
  EXPECT_TRUE(find_added_material(m, Member::flexspline, face).has_value());
  m = {};
  m.end_relief_um = 1.0;
  EXPECT_TRUE(find_added_material(m, Member::flexspline, face).has_value());
}

} // namespace
} // namespace strainwave
