// Curvature of the flanks: the involute's closed form, and circles through three points of the drawn profile.

#include "strainwave/model/tooth/flank_curvature.hpp"
#include "strainwave/model/tooth/profile.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace strainwave {
namespace {

/// Signed curvature of the circle through three points: four times the area of their triangle over the
/// product of its sides.
double circle(const std::array<PolarPoint, 3>& p) {
  std::array<double, 3> x{}, y{};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = p[i].radius_mm * std::cos(p[i].angle_rad);
    y[i] = p[i].radius_mm * std::sin(p[i].angle_rad);
  }
  const double twice_area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  return 2.0 * twice_area /
         (std::hypot(x[1] - x[0], y[1] - y[0]) * std::hypot(x[2] - x[1], y[2] - y[1]) *
          std::hypot(x[2] - x[0], y[2] - y[0]));
}

TEST(FlankCurvature, PlainFlanksHaveTheRadiusOfTheInvolute) {
  const FlankPair pair = FlankPair::make(seed_gear()).value();
  const double cosine = std::cos(20.0 * std::numbers::pi / 180.0);
  for (const double r : {14.16, 14.3, 14.5, 14.58}) {
    const double rho1 =
        std::sqrt(r * r - 14.0 * 14.0 * cosine * cosine); // length of the tangent to the base circle
    const double rho2 = std::sqrt((r + 0.2) * (r + 0.2) - 14.2 * 14.2 * cosine * cosine);
    EXPECT_NEAR(flexspline_curvature(pair, r), 1.0 / rho1, 1e-13);
    EXPECT_NEAR(circular_spline_curvature(pair, r + 0.2), 1.0 / rho2, 1e-13);
  }
}

TEST(FlankCurvature, ModifiedFlanksBendAsTheirDrawnProfileDoes) {
  Gear gear = seed_gear();
  for (FlankModification* m :
       {&gear.flank_modification.flexspline, &gear.flank_modification.circular_spline}) {
    m->tip_relief_um = 6.0;
    m->tip_relief_start = 0.45;
    m->crowning_um = 3.0;
    m->slope_um = 2.0;
    m->spline_um = {0.0, 2.0, 1.0, 3.0};
    m->lead_taper_um = 5.0;
  }
  const FlankPair pair = FlankPair::make(gear, 0.5).value();
  constexpr int points = 1001; // 0.4 µm apart: rounding 1e-15·R/h² ≈ 1e-7, the circle's own error ≈ h²
  for (const Member member : {Member::flexspline, Member::circular_spline}) {
    const auto profile = flank_profile(pair, member, points);
    for (const int k : {50, 200, 400, 600, 800, 950}) { // away from the breaks at h = 1/3, 0.45, 0.55, 2/3
      const auto at = static_cast<std::size_t>(k);
      // 1/mm from the first to the last point; the plain involutes turn right
      const double drawn = -circle({profile[at - 5], profile[at], profile[at + 5]});
      const double r = 14.156 + 0.428 * k / (points - 1.0);
      const double found = member == Member::flexspline
                               ? flexspline_curvature(pair, r)
                               : circular_spline_curvature(pair, profile[at].radius_mm);
      EXPECT_NEAR(found, drawn, 2e-4 * std::abs(found) + 2e-5)
          << (member == Member::flexspline ? "flexspline " : "circular spline ") << k;
      EXPECT_GT(std::abs(found - 1.0 / 6.0), 0.01); // the modification matters here
    }
  }
}

TEST(FlankCurvature, AtTheStartOfAReliefEachSideHasItsOwn) {
  Gear gear = seed_gear();
  gear.flank_modification.flexspline.tip_relief_um = 10.0;
  gear.flank_modification.flexspline.tip_relief_power = 2.0;
  const FlankPair pair = FlankPair::make(gear).value();
  const double kink = 14.156 + 0.5 * 0.428;
  const double plain = flexspline_curvature(FlankPair::make(seed_gear()).value(), kink);
  EXPECT_NEAR(flexspline_curvature(pair, kink - 1e-5), plain, 1e-5);
  // d²m/dr² = 2·0.010/(0.5·0.428)² = 0.437/mm, and along the involute dr/ds = r_b/r = cos α
  const double alpha = std::acos(14.0 * std::cos(20.0 * std::numbers::pi / 180.0) / kink);
  const double bend = 2.0 * 0.010 / (0.214 * 0.214) * std::cos(alpha) * std::cos(alpha);
  EXPECT_NEAR(flexspline_curvature(pair, kink + 1e-5) - plain, bend, 1e-3);
}

TEST(FlankCurvature, LengthAlongTheInvoluteIsThatOfManyChords) {
  const FlankPair pair = FlankPair::make(seed_gear()).value();
  const auto profile = flank_profile(pair, Member::flexspline, 2001);
  double chords = 0.0;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    const double turn = profile[k].angle_rad - profile[k - 1].angle_rad;
    const double a = profile[k].radius_mm, b = profile[k - 1].radius_mm;
    chords += std::sqrt((a - b) * (a - b) + 4.0 * a * b * std::pow(std::sin(0.5 * turn), 2));
  }
  EXPECT_NEAR(flank_length_mm(pair, 14.584) - flank_length_mm(pair, 14.156), chords, 1e-8);
}

} // namespace
} // namespace strainwave
