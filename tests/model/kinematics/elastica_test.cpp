// The exact two-disc curve: what defines it, and agreement of the two solvers.

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/kinematics/shooting.hpp"
#include "tests/model/kinematics/curves.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave::testing_support {
namespace {

using units::pi;

TEST(Elastica, IsInextensible) {
  // Arc length between neighbouring material points, Simpson on the pose's own derivative d(position)/d(phi).
  const NeutralCurve curve = curve_of(seed_with(WaveGeneratorShape::two_disc_exact));
  for (double phi = 0.0; phi < 1.57; phi += 0.01) {
    const PoseDerivatives at = curve.pose_derivatives(phi);
    EXPECT_NEAR(std::hypot(at.rho[by_material_angle], at.value.rho_mm * at.phi1[by_material_angle]), 14.006,
                1e-11);
  }
}

TEST(Elastica, LiesOnTheDiscUpToLiftOffAndClearOfItBeyond) {
  const NeutralCurve curve = curve_of(seed_with(WaveGeneratorShape::two_disc_exact));
  const double radius = *curve.summary().disc_radius_mm, e = *curve.summary().eccentricity_mm;
  const double lift_off = radius * *curve.summary().lift_off_arc_rad / 14.006;
  EXPECT_NEAR(lift_off / degree, 48.904903,
              1e-6); // reference/benchmarks.json, two_disk, material_contact_deg
  for (double phi = 0.0; phi <= 0.5 * pi; phi += 0.01) {
    const Pose pose = curve.pose(phi);
    const double gap =
        std::hypot(pose.rho_mm * std::cos(pose.phi1_rad) - e, pose.rho_mm * std::sin(pose.phi1_rad)) - radius;
    EXPECT_GT(gap, -1e-13);
    EXPECT_LT(gap, phi < lift_off ? 1e-13 : 1.0);
  }
}

TEST(Elastica, BendingMomentFollowsTheAxialForceOnTheFreeArc) {
  // kappa(phi) - 1/R = (N/EI)(y - y_L), with kappa = d(direction)/ds from the pose's derivatives.
  const NeutralCurve curve = curve_of(seed_with(WaveGeneratorShape::two_disc_exact));
  const CurveSummary& summary = curve.summary();
  const double radius = *summary.disc_radius_mm, lift_y = radius * std::sin(*summary.lift_off_arc_rad);
  for (double phi = 0.86; phi <= 1.57; phi += 0.01) {
    const PoseDerivatives at = curve.pose_derivatives(phi);
    const double curvature = (at.phi1[by_material_angle] + at.normal_rotation[by_material_angle]) / 14.006;
    const double y = at.value.rho_mm * std::sin(at.value.phi1_rad);
    EXPECT_NEAR(curvature, 1.0 / radius + *summary.n_over_ei_per_mm2 * (y - lift_y), 1e-13);
  }
}

TEST(Elastica, ShootingWithTightTolerancesAgreesWithTheStoredCurve) {
  for (const double ratio : {2.80, 3.0, 3.5, 4.5, 5.05}) {
    Gear gear = seed_with(WaveGeneratorShape::two_disc_exact);
    gear.wave_generator.eccentricity_mm = 0.2 * ratio;
    const NeutralCurve curve = curve_of(gear);
    const auto shot =
        shoot({.neutral_radius_mm = 14.006, .u0_mm = 0.2, .eccentricity_given = true, .given = 0.2 * ratio},
              {.arc_rad = *curve.summary().lift_off_arc_rad + 0.01,
               .n_over_ei_per_mm2 = *curve.summary().n_over_ei_per_mm2 * 1.02,
               .eccentricity_mm = 0.2 * ratio},
              1e-13);
    ASSERT_TRUE(shot.ok()) << shot.failure().message;
    // CVODES errors accumulate to some hundred tolerances.
    EXPECT_NEAR(shot->arc_rad, *curve.summary().lift_off_arc_rad, 1e-10) << ratio;
    EXPECT_NEAR(shot->n_over_ei_per_mm2, *curve.summary().n_over_ei_per_mm2, 1e-12) << ratio;
  }
}

TEST(Elastica, GoesOverIntoTheFirstOrderCurveForSmallDeformation) {
  // The difference is of second order in u0: a tenth of u0 leaves a hundredth of the difference.
  const auto difference = [](double u0) {
    Gear exact = seed_with(WaveGeneratorShape::two_disc_exact),
         first = seed_with(WaveGeneratorShape::two_disc);
    for (Gear* gear : {&exact, &first}) {
      gear->wave_generator.max_radial_deformation_mm = u0;
      gear->wave_generator.eccentricity_mm = 3.0 * u0;
    }
    double largest = 0.0;
    const NeutralCurve a = curve_of(exact), b = curve_of(first);
    for (double polar = 0.0; polar < 1.57; polar += 0.05)
      largest = std::max(largest, std::abs(a.displacement(polar).u_mm - b.displacement(polar).u_mm));
    return largest;
  };
  EXPECT_NEAR(1e3 * difference(0.2), 8.2, 0.1); // um, independent trial: up to 8.2 um at 54.5 degrees
  EXPECT_NEAR(difference(0.02) / difference(0.002), 100.0, 3.0);
}

TEST(Elastica, WrapAngleInsteadOfEccentricityGivesTheSameCurve) {
  Gear gear = seed_with(WaveGeneratorShape::two_disc_exact);
  const NeutralCurve by_eccentricity = curve_of(gear);
  gear.wave_generator.eccentricity_mm.reset();
  gear.wave_generator.wrap_angle_deg = *by_eccentricity.summary().wrap_angle_rad / degree;
  const NeutralCurve by_angle = curve_of(gear);
  EXPECT_NEAR(*by_angle.summary().eccentricity_mm, 0.6, 1e-12);
  for (double phi = 0.0; phi < 1.57; phi += 0.1)
    EXPECT_NEAR(by_angle.pose(phi).rho_mm, by_eccentricity.pose(phi).rho_mm, 1e-12);
}

TEST(Elastica, IsSmoothInItsParametersToRounding) {
  // Second differences over 1e-6 mm are the curvature (5e-11 here, the same everywhere) plus four rounding
  // errors.
  const auto rho = [](double u0) {
    Gear gear = seed_with(WaveGeneratorShape::two_disc_exact);
    gear.wave_generator.max_radial_deformation_mm = u0;
    return curve_of(gear).pose(0.9).rho_mm;
  };
  double least = 1.0, largest = -1.0;
  for (int i = 0; i < 10; ++i) {
    const double u0 = 0.2 + i * 1e-6;
    const double second = rho(u0 - 1e-6) - 2.0 * rho(u0) + rho(u0 + 1e-6);
    least = std::min(least, second);
    largest = std::max(largest, second);
  }
  EXPECT_LT(largest - least, 1e-12);
}

TEST(Elastica, SolvesOverTheWholeRangeOrSaysWhyNot) {
  int solved = 0;
  for (int i = 0; i <= 100; ++i) {
    const double ratio = 2.753 + (5.278 - 2.753) * i / 100.0;
    for (const double u0 : {0.05, 0.2, 0.5}) {
      Gear gear = seed_with(WaveGeneratorShape::two_disc_exact);
      gear.wave_generator.max_radial_deformation_mm = u0;
      gear.wave_generator.eccentricity_mm = ratio * u0;
      const auto curve = NeutralCurve::make(gear.wave_generator, gear.flexspline);
      if (!curve) {
        EXPECT_FALSE(curve.failure().message.empty());
        EXPECT_TRUE(ratio < 2.76 || ratio > 4.8) << ratio << " " << u0 << " " << curve.failure().message;
        continue;
      }
      ++solved;
      EXPECT_NEAR(curve->pose(0.5 * pi).phi1_rad, 0.5 * pi, 1e-13);
      EXPECT_NEAR(curve->pose(0.5 * pi).normal_rotation_rad, 0.0, 1e-12);
    }
  }
  EXPECT_GT(solved, 260);
}

} // namespace
} // namespace strainwave::testing_support
