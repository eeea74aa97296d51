// The seed gear's initial backlash against tests/reference/kinematics-seed.json (independent program, not
// part of this project) and the statements of the physics notes.

#include "strainwave/model/tooth/backlash.hpp"
#include "strainwave/model/tooth/backlash_gradient.hpp"
#include "tests/model/tooth/curve_of.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <numbers>

namespace strainwave {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

nlohmann::json reference(const char* curve) {
  std::ifstream file(STRAINWAVE_TEST_REFERENCE "/kinematics-seed.json");
  return nlohmann::json::parse(file)[curve]["backlash"];
}

Gear seed(WaveGeneratorShape shape) {
  Gear gear = seed_gear();
  gear.wave_generator.shape = shape;
  return gear;
}

void expect_every_tooth(const Gear& gear, const nlohmann::json& expected) {
  const auto result = backlash(gear, testing_support::curve_of(gear));
  ASSERT_TRUE(result.ok());
  ASSERT_EQ(expected["teeth"].size(), 28u);
  for (const auto& row : expected["teeth"]) {
    const auto at = std::find(result->tooth.begin(), result->tooth.end(), row["tooth"].get<int>());
    ASSERT_NE(at, result->tooth.end());
    const auto k = static_cast<std::size_t>(at - result->tooth.begin());
    SCOPED_TRACE(*at);
    EXPECT_NEAR(result->phi_rad[k] / degree, row["phi_deg"].get<double>(), 1e-12);
    EXPECT_TRUE(result->drive[k].overlap);
    EXPECT_NEAR(result->drive[k].backlash_mm, row["backlash_mm"].get<double>(), 1e-9);
    EXPECT_NEAR(result->drive[k].contact_radius_mm, row["contact_radius_mm"].get<double>(), 1e-9);
  }
}

void expect_least(const Gear& gear, const nlohmann::json& expected) {
  const auto least = least_backlash(gear, testing_support::curve_of(gear));
  ASSERT_TRUE(least.ok());
  EXPECT_NEAR(least->backlash_mm, expected["continuous_minimum"]["backlash_mm"].get<double>(), 1e-12);
  // The reference searched for the least value: its place is known to the square root of rounding, 1e-5
  // degrees.
  EXPECT_NEAR(least->phi_rad / degree, expected["continuous_minimum"]["phi_deg"].get<double>(), 1e-5);
}

TEST(SeedBacklash, EveryToothOnFirstOrderDiscs) {
  expect_every_tooth(seed(WaveGeneratorShape::two_disc), reference("two_disc"));
}

TEST(SeedBacklash, EveryToothOnExactDiscs) {
  expect_every_tooth(seed(WaveGeneratorShape::two_disc_exact), reference("two_disc_exact"));
}

TEST(SeedBacklash, LeastOverContinuousAngleOnFirstOrderDiscs) {
  expect_least(seed(WaveGeneratorShape::two_disc), reference("two_disc"));
}

TEST(SeedBacklash, LeastOverContinuousAngleOnExactDiscs) {
  expect_least(seed(WaveGeneratorShape::two_disc_exact), reference("two_disc_exact"));
}

TEST(SeedBacklash, SmallerCircularSplineShiftInterferes) {
  // Physics notes, section 4: 5.2187 degrees and -0.66 um with x2 = 2.13 on the first-order discs, 75.8 um
  // per unit of x2.
  Gear gear = seed(WaveGeneratorShape::two_disc);
  gear.circular_spline.profile_shift = 2.13;
  const auto least = least_backlash(gear, testing_support::curve_of(gear));
  ASSERT_TRUE(least.ok());
  EXPECT_NEAR(1e3 * least->backlash_mm, -0.66, 0.005);
  EXPECT_NEAR(least->phi_rad / degree, 5.2187, 5e-5);
  EXPECT_TRUE(backlash(gear, testing_support::curve_of(gear))->interference());
  EXPECT_FALSE(backlash(seed(WaveGeneratorShape::two_disc), testing_support::curve_of(gear))->interference());
}

TEST(SeedBacklash, LeastGrowsBy76MicrometresPerUnitOfCircularSplineShift) {
  Gear gear = seed(WaveGeneratorShape::two_disc);
  gear.contact.window_deg = {5.1, 5.2};
  const NeutralCurve curve = testing_support::curve_of(gear);
  const auto at = backlash(gear, curve);
  ASSERT_TRUE(at.ok());
  ASSERT_EQ(at->tooth.size(), 1u);
  const std::vector<std::string> path{"circular_spline.profile_shift"};
  EXPECT_NEAR(1e3 * backlash_gradient(gear, curve, *at, path).drive_mm[0], 75.8, 0.05);
}

TEST(SeedBacklash, EdgesLimitTheGapOfTheUnmodifiedFlanks) {
  const Gear gear = seed(WaveGeneratorShape::two_disc);
  const auto result = backlash(gear, testing_support::curve_of(gear));
  for (std::size_t k = 0; k < result->tooth.size(); ++k) {
    if (result->tooth[k] == -3) {
      EXPECT_EQ(result->drive[k].place, ContactPlace::circular_spline_tip);
    }
    if (result->tooth[k] == 2) {
      EXPECT_EQ(result->drive[k].place, ContactPlace::flexspline_tip);
    }
    if (result->tooth[k] == 2) {
      EXPECT_NEAR(result->drive[k].flank_height, 1.0, 1e-12);
    }
    if (result->tooth[k] == 35) {
      EXPECT_FALSE(result->drive[k].overlap);
    } // on the minor axis
  }
}

} // namespace
} // namespace strainwave
