// Closed forms of the first-order shapes, their wrap condition and their arc length.

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/kinematics/wrap.hpp"
#include "tests/model/kinematics/curves.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace strainwave::testing_support {
namespace {

using units::pi;

Outcome<NeutralCurve> two_disc(double u0, std::optional<double> e, std::optional<double> wrap_deg,
                               WaveGeneratorShape shape = WaveGeneratorShape::two_disc) {
  Gear gear = seed_with(shape);
  gear.wave_generator.max_radial_deformation_mm = u0;
  gear.wave_generator.eccentricity_mm = e;
  gear.wave_generator.wrap_angle_deg = wrap_deg;
  return NeutralCurve::make(gear.wave_generator, gear.flexspline);
}

TEST(TwoDisc, FamilyOfEccentricitiesAndMinorAxes) {
  // e/u0 and u(90)/u0 against gamma: independent trial, nine digits after the point.
  const double family[][3] = {{25, 3.613682901, -1.010508451},
                              {30, 3.446725461, -1.043757989},
                              {35, 3.308123148, -1.080704139},
                              {40, 3.192487218, -1.121212893},
                              {45, 3.095806590, -1.165253233}};
  for (const auto& [gamma_deg, ratio, minor] : family) {
    const auto curve = two_disc(0.2, std::nullopt, gamma_deg);
    ASSERT_TRUE(curve.ok());
    EXPECT_NEAR(*curve->summary().eccentricity_mm / 0.2, ratio, 1e-9);
    EXPECT_NEAR(curve->summary().u90_mm / 0.2, minor, 1e-9);
    const auto back = two_disc(0.2, curve->summary().eccentricity_mm, std::nullopt);
    ASSERT_TRUE(back.ok());
    EXPECT_NEAR(*back->summary().wrap_angle_rad / degree, gamma_deg, 1e-10);
  }
}

TEST(TwoDisc, DisplacementAndTwoDerivativesAreContinuousAtLiftOff) {
  for (const double gamma_deg : {10.0, 51.0420964215888, 70.0, 85.0, 89.4}) {
    const auto curve = two_disc(0.2, std::nullopt, gamma_deg);
    ASSERT_TRUE(curve.ok());
    const double gamma = gamma_deg * degree;
    const RadialDisplacement below = curve->displacement(gamma * (1.0 - 1e-12));
    const RadialDisplacement above = curve->displacement(gamma * (1.0 + 1e-12));
    // Across 2e-12 gamma the smooth change is u''' times that; u''' < 16 u0/eps^2 covers it with room.
    const double eps = 0.5 * pi - gamma, room = 4e-11 * 0.2 * (1.0 + 1.0 / (eps * eps));
    EXPECT_NEAR(below.u_mm, above.u_mm, room);
    EXPECT_NEAR(below.first_mm, above.first_mm, room);
    EXPECT_NEAR(below.second_mm, above.second_mm, room);
  }
}

TEST(TwoDisc, AgreesWithTheTextbookFormulaWhereThatIsWellConditioned) {
  const double gamma = 51.04209642158816 * degree;
  const double a1 = 0.1910231718333814, b1 = 0.12734878122225432,
               k = 0.2 / (a1 - b1); // reference/kinematics-seed.json
  const NeutralCurve curve = curve_of(seed_with(WaveGeneratorShape::two_disc));
  for (double phi = gamma; phi <= 0.5 * pi; phi += 0.01) {
    const double s = std::sin(gamma);
    const double u = k * ((1.0 + s * s) * std::sin(phi) + (0.5 * pi - phi) * std::cos(phi) - 2.0 * s - b1);
    EXPECT_NEAR(curve.displacement(phi).u_mm, u, 1e-13);
  }
}

TEST(TwoDisc, NoWrapOutsideTheRangeOfEccentricities) {
  for (const double ratio : {0.5, 2.0, 2.7519, 5.2791, 8.0})
    for (const auto shape : {WaveGeneratorShape::two_disc, WaveGeneratorShape::two_disc_exact}) {
      const auto curve = two_disc(0.2, 0.2 * ratio, std::nullopt, shape);
      ASSERT_FALSE(curve.ok()) << ratio;
      EXPECT_EQ(curve.failure().status, Status::no_wrap);
      EXPECT_NE(curve.failure().message.find("2.752 < e/u0 < 5.279"), std::string::npos)
          << curve.failure().message;
    }
  for (const double ratio : {2.76, 3.0, 5.27})
    EXPECT_TRUE(two_disc(0.2, 0.2 * ratio, std::nullopt).ok()) << ratio;
}

TEST(TwoDisc, WrapAngleNearNinetyDegreesIsRefusedAndJustBelowIsClean) {
  for (const auto shape : {WaveGeneratorShape::two_disc, WaveGeneratorShape::two_disc_exact}) {
    const auto curve = two_disc(0.2, std::nullopt, 89.9, shape);
    ASSERT_FALSE(curve.ok());
    EXPECT_EQ(curve.failure().status, Status::singular_wave_generator);
  }
  const auto by_ratio = two_disc(0.2, 0.2 * 2.751939, std::nullopt);
  ASSERT_FALSE(by_ratio.ok());
  EXPECT_EQ(by_ratio.failure().status, Status::singular_wave_generator);
  // No noise at the allowed end: the mean stays zero although A1 - B1 is 1.6e-7 there.
  const auto last = two_disc(0.2, std::nullopt, 89.5);
  ASSERT_TRUE(last.ok());
  EXPECT_NEAR(mean_displacement_mm(*last, 2000000), 0.0, 1e-9);
}

TEST(TwoDisc, BothNumbersGivenMustAgree) {
  EXPECT_TRUE(two_disc(0.2, 0.6, 51.0421).ok());
  EXPECT_TRUE(two_disc(0.2, 0.6, 48.4514, WaveGeneratorShape::two_disc_exact).ok());
  for (const auto shape : {WaveGeneratorShape::two_disc, WaveGeneratorShape::two_disc_exact}) {
    const auto curve = two_disc(0.2, 0.6, 45.0, shape);
    ASSERT_FALSE(curve.ok());
    EXPECT_EQ(curve.failure().status, Status::contradiction);
    EXPECT_NE(curve.failure().message.find("45"), std::string::npos);
  }
  const auto neither = two_disc(0.2, std::nullopt, std::nullopt);
  ASSERT_FALSE(neither.ok());
  EXPECT_EQ(neither.failure().status, Status::contradiction);
}

TEST(FourForce, PoleNear44DegreesIsRefused) {
  Gear gear = seed_with(WaveGeneratorShape::four_force);
  for (const double beta_deg : {44.0, 44.3, 44.6}) {
    gear.wave_generator.force_angle_deg = beta_deg;
    const auto curve = NeutralCurve::make(gear.wave_generator, gear.flexspline);
    ASSERT_FALSE(curve.ok()) << beta_deg;
    EXPECT_EQ(curve.failure().status, Status::singular_wave_generator);
  }
  gear.wave_generator.force_angle_deg.reset();
  EXPECT_EQ(NeutralCurve::make(gear.wave_generator, gear.flexspline).failure().status, Status::contradiction);
}

TEST(FourForce, AtZeroAngleItIsTheRingUnderTwoOpposedForces) {
  // Thin ring, two opposed radial loads (reference/benchmarks.json, ring): shortening pi/4 - 2/pi along the
  // load, growth 2/pi - 1/2 across it, both over the diameter. Scaled to u(0) = u0.
  Gear gear = seed_with(WaveGeneratorShape::four_force);
  gear.wave_generator.force_angle_deg = 0.0;
  const NeutralCurve curve = curve_of(gear);
  EXPECT_NEAR(curve.summary().u90_mm / 0.2, -0.13661977236758138 / 0.1487783910298669, 1e-12);
}

TEST(FourForce, TwoDerivativesAreContinuousAtTheForces) {
  const NeutralCurve curve = curve_of(seed_with(WaveGeneratorShape::four_force));
  const RadialDisplacement below = curve.displacement(30.0 * degree * (1.0 - 1e-13));
  const RadialDisplacement above = curve.displacement(30.0 * degree * (1.0 + 1e-13));
  EXPECT_NEAR(below.u_mm, above.u_mm, 1e-12);
  EXPECT_NEAR(below.first_mm, above.first_mm, 1e-12);
  EXPECT_NEAR(below.second_mm, above.second_mm,
              1e-12); // no concentrated moment: u'' (curvature) is continuous, u''' jumps
}

TEST(Ellipse, KeepsThePerimeterOfTheCircle) {
  const NeutralCurve curve = curve_of(seed_with(WaveGeneratorShape::ellipse));
  EXPECT_NEAR(curve.summary().perimeter_excess_mm, 0.0, 1e-12);
  EXPECT_NEAR(curve.pose(90.0 * degree).phi1_rad, 0.5 * pi, 1e-14);
}

TEST(FirstOrder, ArcLengthIsExact) {
  // Independent quadrature of the arc length up to the pose's polar angle, split at the lift-off.
  using boost::math::quadrature::gauss_kronrod;
  for (const WaveGeneratorShape shape : {WaveGeneratorShape::two_disc, WaveGeneratorShape::four_force,
                                         WaveGeneratorShape::ellipse, WaveGeneratorShape::cosine}) {
    const NeutralCurve curve = curve_of(seed_with(shape));
    const auto speed = [&](double polar) {
      const RadialDisplacement u = curve.displacement(polar);
      return std::hypot(14.006 + u.u_mm, u.first_mm);
    };
    const double split = shape == WaveGeneratorShape::four_force ? 30.0 * degree
                         : curve.summary().wrap_angle_rad        ? *curve.summary().wrap_angle_rad
                                                                 : 0.7;
    for (const double phi_deg : {3.0, 29.0, 47.0, 60.0, 89.0}) {
      const Pose pose = curve.pose(phi_deg * degree);
      const double middle = std::min(split, pose.phi1_rad);
      const double length = gauss_kronrod<double, 31>::integrate(speed, 0.0, middle, 5, 1e-15) +
                            gauss_kronrod<double, 31>::integrate(speed, middle, pose.phi1_rad, 5, 1e-15);
      EXPECT_NEAR(length, 14.006 * phi_deg * degree, 1e-13) << phi_deg;
      EXPECT_NEAR(pose.rho_mm, 14.006 + curve.displacement(pose.phi1_rad).u_mm, 1e-13);
    }
  }
}

TEST(EveryShape, IsEvenAndRepeatsAfterHalfATurn) {
  for (const WaveGeneratorShape shape : shapes_without_file) {
    const NeutralCurve curve = curve_of(seed_with(shape));
    for (double phi = -1.5; phi < 1.55; phi += 0.1) {
      const Pose here = curve.pose(phi), mirror = curve.pose(-phi), next = curve.pose(phi + pi),
                 far = curve.pose(phi - 3.0 * pi);
      EXPECT_NEAR(mirror.rho_mm, here.rho_mm, 1e-13);
      EXPECT_NEAR(mirror.phi1_rad, -here.phi1_rad, 1e-14);
      EXPECT_NEAR(mirror.normal_rotation_rad, -here.normal_rotation_rad, 1e-14);
      EXPECT_NEAR(next.rho_mm, here.rho_mm, 1e-13);
      EXPECT_NEAR(next.phi1_rad, here.phi1_rad + pi, 1e-14);
      EXPECT_NEAR(far.phi1_rad, here.phi1_rad - 3.0 * pi, 1e-14);
      EXPECT_NEAR(far.normal_rotation_rad, here.normal_rotation_rad, 1e-14);
      EXPECT_NEAR(curve.displacement(phi + pi).u_mm, curve.displacement(-phi).u_mm, 1e-13);
      EXPECT_NEAR(curve.displacement(phi).first_mm, -curve.displacement(-phi).first_mm, 1e-13);
    }
  }
}

TEST(EveryShape, DerivativesWithRespectToThePolarAngleConvergeWithSecondOrder) {
  for (const WaveGeneratorShape shape : shapes_without_file) {
    const NeutralCurve curve = curve_of(seed_with(shape));
    for (const double polar : {0.2, 0.6, 1.1, 1.5}) {
      const RadialDisplacement u = curve.displacement(polar);
      const auto error = [&](double h) {
        const RadialDisplacement up = curve.displacement(polar + h), down = curve.displacement(polar - h);
        return std::pair{std::abs((up.u_mm - down.u_mm) / (2.0 * h) - u.first_mm),
                         std::abs((up.first_mm - down.first_mm) / (2.0 * h) - u.second_mm)};
      };
      const auto coarse = error(4e-3), fine = error(2e-3);
      EXPECT_NEAR(coarse.first / fine.first, 4.0, 0.1) << polar;
      EXPECT_NEAR(coarse.second / fine.second, 4.0, 0.1) << polar;
    }
  }
}

TEST(EveryShape, FootOfThePerpendicularFindsPointsBesideTheCurve) {
  for (const WaveGeneratorShape shape : shapes_without_file) {
    const NeutralCurve curve = curve_of(seed_with(shape));
    for (double phi = -3.0; phi < 3.1; phi += 0.25)
      for (const double distance : {-0.15, 0.0, 0.4}) {
        const Pose pose = curve.pose(phi);
        const double normal = pose.phi1_rad + pose.normal_rotation_rad;
        const CurveFoot foot =
            curve.foot(pose.rho_mm * std::cos(pose.phi1_rad) + distance * std::cos(normal),
                       pose.rho_mm * std::sin(pose.phi1_rad) + distance * std::sin(normal));
        EXPECT_NEAR(foot.distance_mm, distance, 1e-12);
        EXPECT_NEAR(std::remainder(foot.polar_angle_rad - pose.phi1_rad, 2.0 * pi), 0.0, 1e-13);
        EXPECT_NEAR(std::remainder(foot.normal_angle_rad - normal, 2.0 * pi), 0.0, 1e-13);
      }
  }
}

TEST(EveryShape, MeaninglessNumbersAreRefused) {
  for (const WaveGeneratorShape shape : shapes_without_file) {
    for (const double u0 : {0.0, -0.2, 5.0, std::nan("")}) {
      Gear gear = seed_with(shape);
      gear.wave_generator.max_radial_deformation_mm = u0;
      EXPECT_EQ(NeutralCurve::make(gear.wave_generator, gear.flexspline).failure().status,
                Status::contradiction);
    }
    Gear gear = seed_with(shape);
    gear.flexspline.neutral_radius_mm = 0.0;
    EXPECT_EQ(NeutralCurve::make(gear.wave_generator, gear.flexspline).failure().status,
              Status::contradiction);
  }
}

} // namespace
} // namespace strainwave::testing_support
