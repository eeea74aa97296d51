#include "strainwave/model/tolerance/error_motion.hpp"

#include <cmath>

namespace strainwave {

namespace {

/// The tooth moves along the neutral line to the material angle phi + turn, as if it had been cut there.
ToothMotion material_shift(const MeshPlace& place, double turn_rad) {
  const PoseDerivatives& p = place.pose;
  return {p.rho[by_material_angle] * turn_rad, p.value.rho_mm * p.phi1[by_material_angle] * turn_rad,
          (p.phi1[by_material_angle] + p.normal_rotation[by_material_angle]) * turn_rad};
}

/// Motion in the tooth's own frame: along its normal, across it, and about its point of the neutral line.
ToothMotion in_tooth_frame(const MeshPlace& place, double along, double across, double turn_rad) {
  const double n = place.pose.value.normal_rotation_rad;
  return {along * std::cos(n) - across * std::sin(n), along * std::sin(n) + across * std::cos(n), turn_rad};
}

/// The space moves outwards by w, sideways by v and turns about the point of its pitch circle: the tooth
/// moves back.
ToothMotion against_space(const MeshPlace& place, const MeshNumbers& mesh, double w, double v,
                          double turn_rad) {
  const double rho = place.pose.value.rho_mm;
  const double d = place.pose.value.phi1_rad - place.space_angle_rad;
  const double c = std::cos(d), s = std::sin(d);
  // Components of the space's motion at the tooth: translation, and the turn's lever from the pitch point.
  const double r2 = mesh.circular_spline_pitch_mm;
  const double radial = w * c + v * s - turn_rad * r2 * s;
  const double tangential = -w * s + v * c + turn_rad * (rho - r2 * c);
  return {-radial, -tangential, -turn_rad};
}

ToothMotion turned_in_its_gear(const ToleranceSource& source, double arc_mm, const MeshPlace& place,
                               const MeshNumbers& mesh) {
  if (source.member == Member::flexspline)
    return material_shift(place, arc_mm / mesh.flexspline_pitch_mm);
  const double turn = arc_mm / mesh.circular_spline_pitch_mm;
  return {0.0, -place.pose.value.rho_mm * turn, -turn};
}

} // namespace

std::size_t tolerance_dimensions(const ToleranceSource& source, int flexspline_teeth,
                                 int circular_spline_teeth) {
  switch (source.kind) {
  case ToleranceKind::adjacent_pitch:
    return static_cast<std::size_t>(source.member == Member::flexspline ? flexspline_teeth
                                                                        : circular_spline_teeth);
  case ToleranceKind::backlash_noise:
    return static_cast<std::size_t>(flexspline_teeth);
  case ToleranceKind::tooth_thickness:
  case ToleranceKind::profile_slope:
  case ToleranceKind::profile_form:
  case ToleranceKind::wear:
  case ToleranceKind::gear_key:
    return 1;
  case ToleranceKind::cumulative_pitch:
  case ToleranceKind::run_out:
  case ToleranceKind::centre_offset:
  case ToleranceKind::ovality:
    break;
  }
  return 2;
}

bool is_per_tooth(ToleranceKind kind) {
  return kind == ToleranceKind::adjacent_pitch || kind == ToleranceKind::backlash_noise;
}

bool is_of_shape(ToleranceKind kind) {
  return kind == ToleranceKind::profile_slope || kind == ToleranceKind::profile_form ||
         kind == ToleranceKind::wear || kind == ToleranceKind::gear_key;
}

int error_order(const ToleranceSource& source) {
  switch (source.kind) {
  case ToleranceKind::cumulative_pitch:
    return source.harmonic;
  case ToleranceKind::run_out:
  case ToleranceKind::centre_offset:
    return 1;
  case ToleranceKind::ovality:
    return 2;
  default:
    break;
  }
  return 0;
}

ErrorAtTooth error_vector(const ToleranceSource& source, std::span<const double> values) {
  switch (source.kind) {
  case ToleranceKind::cumulative_pitch:
  case ToleranceKind::run_out:
    return {values[0] * std::cos(values[1]), values[0] * std::sin(values[1])};
  case ToleranceKind::ovality:
    return {values[0] * std::cos(2.0 * values[1]), values[0] * std::sin(2.0 * values[1])};
  case ToleranceKind::centre_offset:
    return {values[0], values[1]};
  case ToleranceKind::adjacent_pitch:
  case ToleranceKind::backlash_noise:
    return {};
  case ToleranceKind::tooth_thickness:
  case ToleranceKind::profile_slope:
  case ToleranceKind::profile_form:
  case ToleranceKind::wear:
  case ToleranceKind::gear_key:
    break;
  }
  return {values[0], 0.0};
}

ToothMotion error_motion(const ToleranceSource& source, const ErrorAtTooth& error, const MeshPlace& place,
                         const MeshNumbers& mesh) {
  const bool on_flexspline = source.member == Member::flexspline;
  switch (source.kind) {
  case ToleranceKind::adjacent_pitch:
  case ToleranceKind::cumulative_pitch:
    return turned_in_its_gear(source, error.first, place, mesh);
  case ToleranceKind::run_out: {
    if (!on_flexspline)
      return against_space(place, mesh, error.first, error.second, 0.0);
    // Moved along the neutral line, but not turned with it.
    const double turn = error.second / mesh.neutral_radius_mm;
    ToothMotion motion = material_shift(place, turn);
    motion += in_tooth_frame(place, error.first, 0.0, -turn);
    return motion;
  }
  case ToleranceKind::tooth_thickness: {
    if (!on_flexspline)
      return turned_in_its_gear(source, 0.5 * error.first, place, mesh);
    // The drive flank turns about the axis of the undeformed gear.
    const double turn = 0.5 * error.first / mesh.flexspline_pitch_mm;
    return in_tooth_frame(place, 0.0, mesh.neutral_radius_mm * turn, turn);
  }
  case ToleranceKind::centre_offset:
    return against_space(place, mesh, error.first, error.second, 0.0);
  case ToleranceKind::ovality: // with t = 2 (theta - psi): first = A cos t, second = -A sin t
    return against_space(place, mesh, error.first, 0.5 * error.second,
                         -1.5 * error.second / mesh.circular_spline_pitch_mm);
  default:
    break;
  }
  return {};
}

} // namespace strainwave
