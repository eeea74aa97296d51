#include "strainwave/model/kinematics/rim_strain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strainwave {

double rim_strain(const NeutralCurve& curve, double rim_thickness_mm) {
  constexpr int places = 180;
  double largest = 0.0;
  for (int k = 0; k <= places; ++k) {
    const PoseDerivatives at = curve.pose_derivatives(0.5 * std::numbers::pi * k / places);
    const double turn = at.phi1[by_material_angle] + at.normal_rotation[by_material_angle]; // r_m κ
    largest = std::max(largest, std::abs(turn - 1.0));
  }
  return 0.5 * rim_thickness_mm / curve.neutral_radius_mm() * largest;
}

} // namespace strainwave
