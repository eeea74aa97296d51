// Points along the flanks against the source text's involute, and the gap profile against the backlash.

#include "strainwave/model/tooth/profile.hpp"
#include "tests/model/tooth/brute_force.hpp"
#include "tests/model/tooth/curve_of.hpp"

#include <gtest/gtest.h>

namespace strainwave::testing_support {
namespace {

TEST(Profile, PlainFlanksAreTheSourceTextsInvolutes) {
  const Gear gear = seed_gear();
  const FlankPair pair = FlankPair::make(gear).value();
  for (const Member member : {Member::flexspline, Member::circular_spline}) {
    const auto points = flank_profile(pair, member, 9);
    const bool tooth = member == Member::flexspline;
    const int teeth = tooth ? 140 : 142;
    const double alpha = 20.0 * std::numbers::pi / 180.0, r = 0.1 * teeth;
    const double theta = (0.5 * std::numbers::pi + 2.0 * (tooth ? 2.13 : 2.19) * std::tan(alpha)) / teeth;
    EXPECT_NEAR(points.front().radius_mm, tooth ? 14.156 : 14.5, 1e-13);
    EXPECT_NEAR(points.back().radius_mm, tooth ? 14.584 : 14.86, 1e-13);
    for (const PolarPoint& p : points) {
      const double c = std::cos(alpha),
                   s = (-std::sin(alpha) + std::sqrt(p.radius_mm * p.radius_mm / (r * r) - c * c)) / c;
      const XY expected = involute(r, alpha, theta, s);
      EXPECT_NEAR(p.radius_mm * std::cos(p.angle_rad), expected.x, 1e-13);
      EXPECT_NEAR(p.radius_mm * std::sin(p.angle_rad), expected.y, 1e-13);
    }
  }
}

TEST(Profile, ModifiedFlanksLieTheRemovalAwayFromThePlainOnes) {
  Gear gear = seed_gear();
  gear.flank_modification.flexspline.tip_relief_um = 10.0;
  gear.flank_modification.circular_spline.crowning_um = 5.0;
  const FlankPair pair = FlankPair::make(gear).value();
  for (const Member member : {Member::flexspline, Member::circular_spline}) {
    const auto points = flank_profile(pair, member, 9);
    // Involutes are parallel curves: the distance to the plain flank shows in the same half angle formula.
    const auto expected = flank_polyline(gear, member, 0.0, 20001);
    for (const PolarPoint& p : points) {
      const double x = p.radius_mm * std::cos(p.angle_rad), y = p.radius_mm * std::sin(p.angle_rad);
      double nearest = 1.0;
      for (const XY& q : expected)
        nearest = std::min(nearest, std::hypot(q.x - x, q.y - y));
      EXPECT_LT(nearest, 3e-5); // point distance of the polyline
    }
  }
}

TEST(Profile, LeastOfTheGapProfileIsTheBacklash) {
  Gear gear = seed_gear();
  gear.flank_modification.flexspline.crowning_um = 20.0;
  const NeutralCurve curve = curve_of(gear);
  const FlankPair pair = FlankPair::make(gear).value();
  for (const double phi : {-0.2, 0.0, 0.1, 0.4}) {
    const Pose pose = curve.pose(phi);
    const ToothBacklash least = pair.drive(pose, phi * 140.0 / 142.0);
    const auto profile = gap_profile(pair, pose, phi * 140.0 / 142.0, 2001);
    ASSERT_EQ(profile.size(), 2001u);
    double smallest = 1.0;
    for (const GapPoint& p : profile)
      smallest = std::min(smallest, p.gap_mm);
    EXPECT_GE(smallest, least.backlash_mm - 1e-14);
    EXPECT_NEAR(smallest, least.backlash_mm, 1e-7);
    const auto at = gap_at_height(pair, pose, phi * 140.0 / 142.0, least.flank_height);
    ASSERT_TRUE(at.has_value());
    EXPECT_NEAR(at->gap_mm, least.backlash_mm, 1e-12);
    EXPECT_NEAR(at->radius_mm, least.contact_radius_mm, 1e-12);
  }
}

TEST(Profile, NoGapWhereTheCircularSplineHasNoFlank) {
  const Gear gear = seed_gear();
  const NeutralCurve curve = curve_of(gear);
  const FlankPair pair = FlankPair::make(gear).value();
  EXPECT_FALSE(
      gap_at_height(pair, curve.pose(0.1), 0.1 * 140.0 / 142.0, 0.05).has_value()); // below the tip circle
  EXPECT_TRUE(gap_profile(pair, curve.pose(1.5), 1.5 * 140.0 / 142.0, 5).empty());
}

TEST(Profile, PosedFlankStandsWhereThePoseSays) {
  const Gear gear = seed_gear();
  const FlankPair pair = FlankPair::make(gear).value();
  // A pose that only turns leaves the profile itself.
  const auto plain = flank_profile(pair, Member::flexspline, 5);
  const auto turned = posed_flank_profile(pair, {14.006, 0.3, 0.0}, 5);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(turned[k].radius_mm, plain[k].radius_mm, 1e-13);
    EXPECT_NEAR(turned[k].angle_rad, plain[k].angle_rad + 0.3, 1e-14);
  }
}

} // namespace
} // namespace strainwave::testing_support
