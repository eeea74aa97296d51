#include "strainwave/model/contact/wave_generator_surface.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace strainwave {
namespace {

constexpr double inner = 13.856;
constexpr double half = 0.15;

WaveGeneratorSurface seed_discs(bool linearised = false) {
  return {WaveGeneratorSurface::Discs{
              .eccentricity_mm = 0.6, .neutral_disc_radius_mm = 13.606, .linearised = linearised},
          inner, half};
}

WaveGeneratorSurface elliptic_cam() {
  Gear gear = seed_gear();
  gear.wave_generator.shape = WaveGeneratorShape::ellipse;
  gear.wave_generator.eccentricity_mm.reset();
  const NeutralCurve curve = NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
  return {[curve](double x, double y) {
            const CurveFoot foot = curve.foot(x, y);
            return WaveGeneratorSurface::Foot{foot.distance_mm, foot.normal_angle_rad};
          },
          inner, half};
}

TEST(WaveGeneratorSurface, WallPointPlacedOnTheDiscHasNoGap) {
  // A point of the disc at 20° about its centre (0.6, 0), radius 13.456.
  const double x = 0.6 + 13.456 * std::cos(0.35);
  const double y = 13.456 * std::sin(0.35);
  const double phi = 0.36;
  const double w = x * std::cos(phi) + y * std::sin(phi) - inner;
  const double v = -x * std::sin(phi) + y * std::cos(phi);
  const WallGap g = seed_discs().gap(phi, 24.5, w, v);
  EXPECT_NEAR(g.gap_mm, 0.0, 1e-14);
  // The normal points from the disc's centre: at 0.35 rad, seen in the frame of phi.
  EXPECT_NEAR(g.radial, std::cos(0.35 - phi), 1e-14);
  EXPECT_NEAR(g.circumferential, std::sin(0.35 - phi), 1e-14);
}

TEST(WaveGeneratorSurface, SecondDiscIsTheFirstTurnedByHalfARevolution) {
  const WallGap one = seed_discs().gap(0.4, 24.5, 0.1, -0.05);
  const WallGap two = seed_discs().gap(0.4 - std::numbers::pi, 24.5, 0.1, -0.05);
  EXPECT_NEAR(one.gap_mm, two.gap_mm, 1e-14);
  EXPECT_NEAR(one.circumferential, two.circumferential, 1e-14);
}

TEST(WaveGeneratorSurface, LinearisedGapIsTheFormulaOfTheNeutralLine) {
  const WallGap g = seed_discs(true).gap(0.5, 24.5, 0.12, -0.08);
  const double expected =
      0.12 - (0.6 * std::cos(0.5) + std::sqrt(13.606 * 13.606 - std::pow(0.6 * std::sin(0.5), 2)) - 14.006);
  EXPECT_NEAR(g.gap_mm, expected, 1e-14);
  EXPECT_EQ(g.circumferential, 0.0);
}

TEST(WaveGeneratorSurface, CamGapIsTheDistanceToTheNearestPointOfTheEllipse) {
  // The ellipse with the undeformed perimeter and a = 14.206: b from Ramanujan's second formula, exact to
  // 1e-12 here.
  const double a = 14.206;
  double b = 13.8;
  const auto perimeter = [&](double minor) {
    const double h = std::pow((a - minor) / (a + minor), 2);
    return std::numbers::pi * (a + minor) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
  };
  for (int i = 0; i < 60; ++i)
    b -= (perimeter(b) - 2 * std::numbers::pi * 14.006) / std::numbers::pi;
  const double phi = 0.7;
  const double w = 0.05;
  const double v = -0.06;
  const double x = (inner + w) * std::cos(phi) - v * std::sin(phi);
  const double y = (inner + w) * std::sin(phi) + v * std::cos(phi);
  double nearest = 1e9;
  for (int i = 0; i <= 1000000; ++i) { // brute force over the eccentric anomaly near 0.7
    const double t = 0.65 + 0.1 * i / 1000000;
    nearest = std::min(nearest, std::hypot(x - a * std::cos(t), y - b * std::sin(t)));
  }
  // The wall point lies inside the neutral curve, so the signed distance is −nearest, and t/2 is added. A
  // step of 1e-7 misses the foot by at most 7e-7 mm along the curve: (7e-7)²/(2·0.1) in distance.
  EXPECT_NEAR(elliptic_cam().gap(phi, 0.0, w, v).gap_mm, half - nearest, 1e-11);
}

TEST(WaveGeneratorSurface, NormalIsTheDerivativeOfTheGap) {
  for (const WaveGeneratorSurface& surface : {seed_discs(), elliptic_cam()}) {
    const double h = 1e-5;
    const auto g = surface.gap(0.8, 24.5, 0.03, -0.07);
    const double dw =
        (surface.gap(0.8, 24.5, 0.03 + h, -0.07).gap_mm - surface.gap(0.8, 24.5, 0.03 - h, -0.07).gap_mm) /
        (2 * h);
    const double dv =
        (surface.gap(0.8, 24.5, 0.03, -0.07 + h).gap_mm - surface.gap(0.8, 24.5, 0.03, -0.07 - h).gap_mm) /
        (2 * h);
    // rounding of a 14 mm distance over 2e-5 mm: 1e-10; truncation h²/R² smaller still
    EXPECT_NEAR(g.radial, dw, 1e-9);
    EXPECT_NEAR(g.circumferential, dv, 1e-9);
    EXPECT_NEAR(std::hypot(g.radial, g.circumferential), 1.0, 1e-14);
  }
}

TEST(WaveGeneratorSurface, ConeMakesTheFrontOfTheDiscSmaller) {
  const WaveGeneratorSurface cone(WaveGeneratorSurface::Discs{.eccentricity_mm = 0.6,
                                                              .neutral_disc_radius_mm = 13.606,
                                                              .taper_per_mm = 0.002,
                                                              .middle_z_mm = 24.5},
                                  inner, half);
  const double middle = seed_discs().gap(0.1, 24.5, 0.2, 0.0).gap_mm;
  EXPECT_NEAR(cone.gap(0.1, 24.5, 0.2, 0.0).gap_mm, middle, 1e-14);
  EXPECT_NEAR(cone.gap(0.1, 26.5, 0.2, 0.0).gap_mm, middle + 0.004, 1e-14);
}

} // namespace
} // namespace strainwave
