// Bending strain of the rim against closed forms: a ring bent to cos 2φ, and the first integral of the
// elastica.

#include "strainwave/model/kinematics/rim_strain.hpp"

#include "strainwave/model/gear/gear.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

TEST(RimStrain, OfACosineIsThatOfTheInextensibleRing) {
  Gear gear = seed_gear();
  gear.wave_generator.shape = WaveGeneratorShape::cosine;
  gear.wave_generator.eccentricity_mm.reset();
  gear.wave_generator.max_radial_deformation_mm = 1e-3; // first order in u0/r
  const double r = gear.flexspline.neutral_radius_mm, t = gear.flexspline.rim_thickness_mm;
  const auto curve = NeutralCurve::make(gear.wave_generator, gear.flexspline);
  ASSERT_TRUE(curve);
  const double expected = 0.5 * t * 3.0 * 1e-3 / (r * r);        // w'' + w = −3 u0 cos 2φ
  EXPECT_NEAR(rim_strain(*curve, t), expected, 1e-3 * expected); // u0/r = 7e-5, a few of them
}

TEST(RimStrain, OnTwoDiscsFollowsTheFirstIntegralOfTheElastica) {
  // κ κ' ds = (N/EI) sin ψ dψ from lift-off (κ = 1/R, ψ = π/2 + β) to the minor axis (ψ = π)
  const Gear gear = seed_gear();
  const auto curve = NeutralCurve::make(gear.wave_generator, gear.flexspline);
  ASSERT_TRUE(curve);
  const CurveSummary& s = curve->summary();
  const double on_disc = 1.0 / *s.disc_radius_mm;
  const double minor =
      std::sqrt(on_disc * on_disc + 2.0 * *s.n_over_ei_per_mm2 * (1.0 - std::sin(*s.lift_off_arc_rad)));
  const double free = 1.0 / gear.flexspline.neutral_radius_mm;
  const double expected =
      0.5 * gear.flexspline.rim_thickness_mm * std::max(std::abs(on_disc - free), std::abs(minor - free));
  EXPECT_NEAR(rim_strain(*curve, gear.flexspline.rim_thickness_mm), expected, 1e-6 * expected);
}

} // namespace
} // namespace strainwave
