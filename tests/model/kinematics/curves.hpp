#pragma once
// Curves of the seed gear and its variations, for the tests of kinematics.

#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"

#include <numbers>

namespace strainwave::testing_support {

inline constexpr double degree = std::numbers::pi / 180.0;

inline Gear seed_with(WaveGeneratorShape shape) {
  Gear gear = seed_gear();
  gear.wave_generator.shape = shape;
  if (shape == WaveGeneratorShape::four_force)
    gear.wave_generator.force_angle_deg = 30.0;
  return gear;
}

/// Throws (and so fails the test with the sentence) when there is no curve.
inline NeutralCurve curve_of(const Gear& gear) {
  return NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
}

inline constexpr WaveGeneratorShape shapes_without_file[] = {
    WaveGeneratorShape::two_disc, WaveGeneratorShape::two_disc_exact, WaveGeneratorShape::four_force,
    WaveGeneratorShape::ellipse, WaveGeneratorShape::cosine};

/// Mean of u over the polar angle: Gauss would do, but the trapezium on a fine grid is independent of the
/// code under test.
inline double mean_displacement_mm(const NeutralCurve& curve, int points = 20000) {
  double sum = 0.0;
  for (int i = 0; i < points; ++i)
    sum += curve.displacement((i + 0.5) * std::numbers::pi / points).u_mm;
  return sum / points;
}

} // namespace strainwave::testing_support
