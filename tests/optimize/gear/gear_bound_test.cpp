// The bound of real gears, on a coarse cup: never above what a design reaches, and the plain bound where
// there is nothing to lump.

#include "strainwave/optimize/gear/gear_bound.hpp"

#include "strainwave/model/loading/phase_problem.hpp"
#include "tests/support/coarse_seed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace strainwave {
namespace {

constexpr double anything = -std::numeric_limits<double>::infinity();

Gear coarse_gear(Fidelity fidelity, int heights) {
  Gear gear = testing_support::coarse_seed_gear(testing_support::two_row_mesh);
  gear.contact.fidelity = fidelity;
  gear.contact.flank_points = heights;
  gear.load = {.torque_nm = {7.0}, .rotation_rad = {}, .phases = 1};
  return gear;
}

DesignSpace x2_design(double lower, double upper) {
  return DesignSpace({{.path = NumberPath("circular_spline.profile_shift"),
                       .lower = lower,
                       .upper = upper,
                       .start = lower,
                       .links = {}}});
}

TEST(GearBound, WithOnePointAToothIsTheBoundOfComplianceAndClearance) {
  const Gear gear = coarse_gear(Fidelity::linear, 1);
  ForwardModel model({.disk_cache = false});
  const ForwardResult result = model.analyze(gear);
  std::vector<double> clearance_um, radius_mm;
  const auto problem = model.phase_problems(gear);
  ASSERT_TRUE(problem);
  for (const int tooth : result.compliance->tooth) {
    const auto at = std::find(result.backlash->tooth.begin(), result.backlash->tooth.end(), tooth);
    const auto k = static_cast<std::size_t>(at - result.backlash->tooth.begin());
    clearance_um.push_back(result.backlash->backlash_um[k]);
    radius_mm.push_back(result.backlash->contact_radius_mm[k]);
  }
  const double rotation = 1.05 * result.load[0].rotation_rad;
  const auto plain =
      least_peak_force(result.compliance->matrix_um_per_n, clearance_um, radius_mm, 7.0, rotation);
  const auto clearance = least_clearance(model, gear, x2_design(2.19, 2.1900001), anything);
  ASSERT_TRUE(plain && clearance);
  const auto bound = gear_force_bound(model, gear, *clearance, 7.0, rotation);
  ASSERT_TRUE(bound && *bound);
  EXPECT_NEAR((*bound)->peak_force_n, plain->peak_force_n,
              1e-6 * plain->peak_force_n); // 1e-7 of x2 is 8e-6 µm
  EXPECT_EQ((*bound)->tooth.size(), plain->last - plain->first + 1);
}

TEST(GearBound, NoDesignOfTheBoxIsBetter) {
  for (const auto& [fidelity, heights] :
       {std::pair{Fidelity::linear, 1}, {Fidelity::linear, 6}, {Fidelity::unilateral, 6}}) {
    {
      Gear gear = coarse_gear(fidelity, heights);
      gear.contact.disc_gap = DiscGap::linearised; // as the bound has it
      ForwardModel model({.disk_cache = false});
      const auto clearance = least_clearance(model, gear, x2_design(2.16, 2.22), anything);
      ASSERT_TRUE(clearance) << clearance.failure().message;
      EXPECT_EQ(clearance->corners, 3);
      EXPECT_EQ(clearance->without_result, 0);
      for (const double shift : {2.165, 2.18, 2.21}) {
        for (const double relief_um : {0.0, 4.0}) {
          gear.circular_spline.profile_shift = shift;
          gear.flank_modification.flexspline.tip_relief_um = relief_um;
          gear.flank_modification.flexspline.root_relief_um = 0.5 * relief_um;
          const ForwardResult result = model.analyze(gear);
          ASSERT_EQ(result.status, Status::ok) << result.message;
          const auto bound = gear_force_bound(model, gear, *clearance, 7.0, result.load[0].rotation_rad);
          ASSERT_TRUE(bound && *bound);
          EXPECT_LE((*bound)->peak_force_n, result.load[0].peak_force_n * (1 + 1e-9));
          double torque = 0.0; // a set of teeth that carries the torque at most at the tip circle
          for (const double force : (*bound)->force_n)
            torque += 2e-3 * force * gear.circular_spline.root_radius_mm;
          EXPECT_GE(torque, 7.0);
        }
      }
    }
  }
}

TEST(GearBound, ClearanceThatEveryDesignKeepsRaisesIt) {
  const Gear gear = coarse_gear(Fidelity::linear, 1);
  ForwardModel model({.disk_cache = false});
  const DesignSpace design = x2_design(2.16, 2.22);
  const auto any = least_clearance(model, gear, design, anything);
  const auto kept = least_clearance(model, gear, design, 0.006);
  ASSERT_TRUE(any && kept);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [tooth, clearance] : kept->by_phase[0])
    least = std::min(least, clearance);
  EXPECT_EQ(least, 0.006);
  const double rotation = 1.7e-3; // rad; with 6 µm everywhere more than that is needed
  const auto low = gear_force_bound(model, gear, *any, 7.0, rotation);
  const auto high = gear_force_bound(model, gear, *kept, 7.0, rotation);
  ASSERT_TRUE(low && high);
  EXPECT_TRUE(low->has_value());
  EXPECT_FALSE(high->has_value());
}

TEST(GearBound, TooLittleRotationHasNone) {
  const Gear gear = coarse_gear(Fidelity::unilateral, 1);
  ForwardModel model({.disk_cache = false});
  const auto clearance = least_clearance(model, gear, x2_design(2.19, 2.1900001), anything);
  ASSERT_TRUE(clearance);
  const auto bound = gear_force_bound(model, gear, *clearance, 7.0, 5e-4);
  ASSERT_TRUE(bound);
  EXPECT_FALSE(bound->has_value());
}

} // namespace
} // namespace strainwave
