// A thousand random gears (tooth numbers, shifts, radii, shapes of the wave generator, modifications): the
// search agrees with brute force, derivatives are finite numbers, and every refusal has a sentence.

#include "strainwave/model/tooth/backlash.hpp"
#include "strainwave/model/tooth/backlash_gradient.hpp"
#include "tests/model/tooth/brute_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace strainwave::testing_support {
namespace {

class RandomGear {
public:
  explicit RandomGear(unsigned seed) : engine_(seed) {}
  double between(double lo, double hi) {
    return lo + (hi - lo) * (engine_() * 0x1p-32);
  } // the same on every library
  bool chance(double probability) { return between(0.0, 1.0) < probability; }

  Gear draw() {
    Gear gear = seed_gear();
    Flexspline& f = gear.flexspline;
    CircularSpline& c = gear.circular_spline;
    f.teeth = static_cast<int>(between(50.0, 320.0));
    c.teeth = f.teeth + 2;
    const double m = f.module_mm = 28.0 / f.teeth;
    f.pressure_angle_deg = between(12.0, 30.0);
    f.profile_shift = between(-0.5, 3.0);
    c.profile_shift = f.profile_shift + between(-0.1, 0.3);
    f.root_radius_mm = 14.0 + m * (f.profile_shift - 1.35);
    f.tip_radius_mm = f.root_radius_mm + m * between(1.0, 2.2);
    f.neutral_radius_mm = f.root_radius_mm - 0.15;
    c.tip_radius_mm = 0.5 * m * c.teeth + m * (c.profile_shift - between(0.5, 1.1));
    c.root_radius_mm = c.tip_radius_mm + m * between(1.2, 2.4);
    WaveGenerator& w = gear.wave_generator;
    w.shape = static_cast<WaveGeneratorShape>(static_cast<int>(between(0.0, 5.0))); // all but table
    w.max_radial_deformation_mm = m * between(0.7, 1.3);
    w.eccentricity_mm = w.max_radial_deformation_mm * between(2.7, 5.0);
    if (w.shape == WaveGeneratorShape::four_force)
      w.force_angle_deg = between(0.0, 90.0);
    modify(gear.flank_modification.flexspline);
    modify(gear.flank_modification.circular_spline);
    return gear;
  }

private:
  void modify(FlankModification& k) {
    if (chance(0.5)) {
      k.tip_relief_um = between(0.0, 15.0);
      k.tip_relief_start = between(0.0, 0.95);
      k.tip_relief_power = chance(0.3) ? 1.0 : between(1.0, 4.0);
    }
    if (chance(0.3)) {
      k.root_relief_um = between(0.0, 10.0);
      k.root_relief_start = between(0.05, 1.0);
    }
    if (chance(0.3))
      k.crowning_um = between(0.0, 10.0);
    if (chance(0.4))
      k.slope_um = between(-8.0, 8.0);
    if (chance(0.4))
      for (int knots = static_cast<int>(between(1.0, 8.0)); knots > 0; --knots)
        k.spline_um.push_back(between(3.0, 12.0));
  }

  std::mt19937 engine_;
};

void expect_sound(const Gear& gear, double phase, int& compared) {
  const auto curve = NeutralCurve::make(gear.wave_generator, gear.flexspline);
  if (!curve) {
    EXPECT_FALSE(curve.failure().message.empty());
    return;
  }
  const auto result = backlash(gear, *curve, phase);
  if (!result) {
    EXPECT_FALSE(result.failure().message.empty());
    return;
  }
  const std::vector<std::string> paths = backlash_parameters(gear, *curve);
  const BacklashGradient gradient = backlash_gradient(gear, *curve, *result, paths);
  for (const auto* list :
       {&gradient.drive_mm, &gradient.coast_mm, &gradient.drive_radius_mm, &gradient.coast_radius_mm})
    EXPECT_TRUE(std::all_of(list->begin(), list->end(), [](double x) { return std::isfinite(x); }));
  // Brute force differentiates its normals and has none at the cusp where an involute starts on its base
  // circle.
  const double base_per_tooth = 0.5 * gear.flexspline.module_mm *
                                std::cos(gear.flexspline.pressure_angle_deg * std::numbers::pi / 180.0);
  if (gear.flexspline.root_radius_mm < 1.001 * base_per_tooth * gear.flexspline.teeth ||
      gear.circular_spline.tip_radius_mm < 1.001 * base_per_tooth * gear.circular_spline.teeth)
    return;
  const double ratio = static_cast<double>(gear.flexspline.teeth) / gear.circular_spline.teeth;
  for (std::size_t k = 0; k < result->tooth.size(); k += result->tooth.size() / 3 + 1) {
    const double folded = result->phi_rad[k] - result->lobe[k] * std::numbers::pi;
    const BruteForce expected = brute_force_backlash(gear, curve->pose(folded), folded * ratio, 0.0, 1500);
    const ToothBacklash& drive = result->drive[k];
    ASSERT_EQ(drive.overlap, expected.overlap);
    if (!expected.overlap)
      continue;
    ++compared;
    // Flanks up to 1.2 mm: points 8e-4 mm apart, so interpolation to 1e-7 mm; beside a kink half a spacing at
    // slopes up to 0.1.
    EXPECT_LT(drive.backlash_mm, expected.backlash_mm + 1e-7);
    EXPECT_GT(drive.backlash_mm, expected.backlash_mm - 4e-5);
  }
}

TEST(RandomGears, AgreeWithBruteForce) {
  RandomGear random(11);
  int compared = 0;
  for (int n = 0; n < 60; ++n) {
    SCOPED_TRACE(n);
    expect_sound(random.draw(), random.between(0.0, 1.0), compared);
  }
  EXPECT_GT(compared, 30);
}

TEST(RandomGearsNightly, AgreeWithBruteForce) {
  RandomGear random(12);
  int compared = 0;
  for (int n = 0; n < 2000; ++n) {
    SCOPED_TRACE(n);
    expect_sound(random.draw(), random.between(0.0, 1.0), compared);
  }
  EXPECT_GT(compared, 1000);
}

} // namespace
} // namespace strainwave::testing_support
