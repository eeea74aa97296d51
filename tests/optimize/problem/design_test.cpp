#include "strainwave/optimize/problem/design.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

DesignSpace two_variables() {
  return DesignSpace({{.path = NumberPath("flank_modification.flexspline.tip_relief_um"),
                       .lower = 0.0,
                       .upper = 15.0,
                       .start = 3.0,
                       .scale = 5.0,
                       .links = {}},
                      {.path = NumberPath("wave_generator.max_radial_deformation_mm"),
                       .lower = 0.19,
                       .upper = 0.21,
                       .start = 0.2,
                       .links = {{NumberPath("wave_generator.eccentricity_mm"), 3.0}}}});
}

TEST(DesignSpace, PutsItsNumbersAndTheLinkedOnesIntoTheGear) {
  const Gear gear = two_variables().apply(seed_gear(), std::vector{4.5, 0.195});
  EXPECT_EQ(gear.flank_modification.flexspline.tip_relief_um, 4.5);
  EXPECT_EQ(gear.wave_generator.max_radial_deformation_mm, 0.195);
  EXPECT_EQ(*gear.wave_generator.eccentricity_mm, 3.0 * 0.195);
}

TEST(DesignSpace, LeavesTheRestOfTheGearAlone) {
  const DesignSpace design = two_variables();
  const Gear gear = design.apply(seed_gear(), design.read(seed_gear()));
  Gear expected = seed_gear();
  expected.wave_generator.eccentricity_mm = 3.0 * 0.2;
  EXPECT_EQ(canonical_bits(gear), canonical_bits(expected));
}

TEST(DesignSpace, ScalesByTheTypicalChangeOrTheRange) {
  const DesignSpace design = two_variables();
  const std::vector<double> y = design.scaled(std::vector{5.0, 0.2});
  EXPECT_DOUBLE_EQ(y[0], 1.0);   // 5 µm is one scale above the lower bound
  EXPECT_NEAR(y[1], 0.5, 1e-13); // the middle of the range
  EXPECT_DOUBLE_EQ(design.scaled_upper()[0], 3.0);
  EXPECT_DOUBLE_EQ(design.scaled_upper()[1], 1.0);
}

TEST(DesignSpace, MeetsItsBoundsExactlyWhateverTheRounding) {
  const DesignSpace design = two_variables();
  EXPECT_EQ(design.unscaled(std::vector{0.0, 0.0}), (std::vector{0.0, 0.19}));
  EXPECT_EQ(design.unscaled(design.scaled_upper()), (std::vector{15.0, 0.21}));
  EXPECT_EQ(design.unscaled(std::vector{-1e-16, 1.0 + 1e-15}), (std::vector{0.0, 0.21}));
}

TEST(DesignSpace, RefusesBoundsThatCrossAndStartsOutsideThem) {
  const auto design = [](double lower, double upper, double start) {
    return DesignSpace({{.path = NumberPath("circular_spline.profile_shift"),
                         .lower = lower,
                         .upper = upper,
                         .start = start,
                         .links = {}}});
  };
  EXPECT_THROW(design(2.2, 2.1, 2.15), FieldError);
  EXPECT_THROW(design(2.1, 2.2, 2.3), FieldError);
  EXPECT_NO_THROW(design(2.1, 2.2, 2.2));
}

} // namespace
} // namespace strainwave
