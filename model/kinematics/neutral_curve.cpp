#include "strainwave/model/kinematics/neutral_curve.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/kinematics/curve_shape.hpp"

#include <fmt/format.h>

#include <cmath>

namespace strainwave {
namespace {

using units::pi;

/// angle = turns * pi + side * quarter, quarter in [0, pi/2], side +-1.
struct Folded {
  double turns, side, quarter;
};

Folded fold(double angle) {
  // Rounding just past 90 degrees belongs to the first lobe, as +90 itself does.
  const double turns = std::ceil(angle / pi - 0.5 - 1e-14);
  const double rest = angle - turns * pi;
  return {turns, rest < 0.0 ? -1.0 : 1.0, std::min(std::abs(rest), 0.5 * pi)};
}

std::optional<Failure> check_numbers(const WaveGenerator& generator, double radius) {
  const double u0 = generator.max_radial_deformation_mm;
  if (!(radius > 0.0) || !std::isfinite(radius))
    return Failure{Status::contradiction,
                   fmt::format("neutral_radius_mm {} is not a positive length", radius)};
  if (generator.shape == WaveGeneratorShape::table)
    return std::nullopt;
  if (!(u0 > 0.0) || !(u0 < 0.2 * radius))
    return Failure{Status::contradiction,
                   fmt::format("max_radial_deformation_mm {} must be positive and less than a fifth of "
                               "neutral_radius_mm {}",
                               u0, radius)};
  return std::nullopt;
}

} // namespace

Outcome<NeutralCurve> NeutralCurve::make(const WaveGenerator& generator, const Flexspline& flexspline) {
  const double radius = flexspline.neutral_radius_mm;
  if (auto failure = check_numbers(generator, radius))
    return *failure;
  auto made = generator.shape == WaveGeneratorShape::two_disc_exact ? make_elastica(generator, radius)
                                                                    : make_polar_curve(generator, radius);
  if (!made)
    return made.failure();
  NeutralCurve curve;
  curve.curve_ = *made;
  curve.summary_ = curve.curve_->summary();
  curve.shape_ = generator.shape;
  curve.neutral_radius_ = radius;
  const bool discs = generator.shape == WaveGeneratorShape::two_disc ||
                     generator.shape == WaveGeneratorShape::two_disc_exact;
  if (discs)
    curve.shape_number_path_ =
        generator.eccentricity_mm ? "wave_generator.eccentricity_mm" : "wave_generator.wrap_angle_deg";
  if (generator.shape == WaveGeneratorShape::four_force)
    curve.shape_number_path_ = "wave_generator.force_angle_deg";
  return curve;
}

Pose NeutralCurve::pose(double material_angle_rad) const {
  const Folded at = fold(material_angle_rad);
  const Pose pose = curve_->pose(at.quarter);
  return {pose.rho_mm, at.turns * pi + at.side * pose.phi1_rad, at.side * pose.normal_rotation_rad};
}

PoseDerivatives NeutralCurve::pose_derivatives(double material_angle_rad) const {
  const Folded at = fold(material_angle_rad);
  PoseDerivatives result = curve_->pose_derivatives(at.quarter);
  result.value.phi1_rad = at.turns * pi + at.side * result.value.phi1_rad;
  result.value.normal_rotation_rad *= at.side;
  result.rho[by_material_angle] *= at.side;
  for (std::size_t j = by_neutral_radius; j <= by_shape_number; ++j) {
    result.phi1[j] *= at.side;
    result.normal_rotation[j] *= at.side;
  }
  return result;
}

RadialDisplacement NeutralCurve::displacement(double polar_angle_rad) const {
  const Folded at = fold(polar_angle_rad);
  RadialDisplacement u = curve_->displacement(at.quarter);
  u.first_mm *= at.side;
  return u;
}

CurveFoot NeutralCurve::foot(double x_mm, double y_mm) const {
  // Newton on the tangential offset of the point from the foot, started at the point's own polar angle; the
  // curve is nearly a circle, so the offset's slope is nearly -rho.
  double angle = std::atan2(y_mm, x_mm);
  CurveFoot foot;
  for (int step = 0; step < 20; ++step) {
    const RadialDisplacement u = displacement(angle);
    const double rho = neutral_radius_ + u.u_mm, c = std::cos(angle), s = std::sin(angle);
    const double dx = x_mm - rho * c, dy = y_mm - rho * s;
    const double speed = std::hypot(rho, u.first_mm);
    const double tx = (u.first_mm * c - rho * s) / speed, ty = (u.first_mm * s + rho * c) / speed;
    const double along = dx * tx + dy * ty;
    foot = {dx * ty - dy * tx, angle, std::atan2(-tx, ty)};
    const double curvature =
        (rho * rho + 2.0 * u.first_mm * u.first_mm - rho * u.second_mm) / (speed * speed * speed);
    const double correction = along / (speed * (1.0 + curvature * foot.distance_mm));
    angle += correction;
    if (std::abs(correction) < 1e-15 * pi)
      break;
  }
  return foot;
}

} // namespace strainwave
