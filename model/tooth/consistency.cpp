#include "strainwave/model/tooth/consistency.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/tooth/flank_modification.hpp"

#include <fmt/format.h>

#include <cmath>

namespace strainwave {
namespace {

using units::pi;

template <class... Values>
Failure contradiction(fmt::format_string<Values...> text, Values&&... values) {
  return {Status::contradiction, fmt::format(text, std::forward<Values>(values)...)};
}

struct InvoluteTooth {
  double base_radius, base_angle;
  InvoluteTooth(double module, double alpha, int teeth, double shift)
      : base_radius(0.5 * module * teeth * std::cos(alpha)),
        base_angle((0.5 * pi + 2.0 * shift * std::tan(alpha)) / teeth + std::tan(alpha) - alpha) {}
  double half_angle(double radius) const {
    const double t = std::sqrt(std::max(0.0, (radius / base_radius) * (radius / base_radius) - 1.0));
    return base_angle - t + std::atan(t);
  }
};

double alpha_of(const Gear& gear) {
  return gear.flexspline.pressure_angle_deg * pi / 180.0;
}
InvoluteTooth flexspline_tooth(const Gear& gear) {
  return {gear.flexspline.module_mm, alpha_of(gear), gear.flexspline.teeth, gear.flexspline.profile_shift};
}
InvoluteTooth circular_spline_space(const Gear& gear) {
  return {gear.flexspline.module_mm, alpha_of(gear), gear.circular_spline.teeth,
          gear.circular_spline.profile_shift};
}

std::optional<Failure> find_in_basics(const Gear& gear) {
  const Flexspline& f = gear.flexspline;
  const CircularSpline& c = gear.circular_spline;
  for (const auto& [name, value] : {std::pair{"flexspline.module_mm", f.module_mm},
                                    {"flexspline.tip_radius_mm", f.tip_radius_mm},
                                    {"flexspline.root_radius_mm", f.root_radius_mm},
                                    {"flexspline.neutral_radius_mm", f.neutral_radius_mm},
                                    {"circular_spline.tip_radius_mm", c.tip_radius_mm},
                                    {"circular_spline.root_radius_mm", c.root_radius_mm}})
    if (!(value > 0.0) || !std::isfinite(value))
      return contradiction("{} {} is not a positive length", name, value);
  if (!(f.pressure_angle_deg > 0.0 && f.pressure_angle_deg < 45.0))
    return contradiction("flexspline.pressure_angle_deg {} must lie between 0 and 45", f.pressure_angle_deg);
  if (f.teeth < 4)
    return contradiction("flexspline.teeth {} is not a gear", f.teeth);
  if (c.teeth != f.teeth + 2)
    return contradiction(
        "circular_spline.teeth {} must be flexspline.teeth {} + 2 for a wave generator with two lobes",
        c.teeth, f.teeth);
  if (!std::isfinite(f.profile_shift) || !std::isfinite(c.profile_shift))
    return contradiction("profile_shift must be a finite number");
  return std::nullopt;
}

} // namespace

ToothThickness tooth_thickness(const Gear& gear) {
  const double tip = gear.flexspline.tip_radius_mm, inner = gear.circular_spline.tip_radius_mm;
  return {2.0 * tip * flexspline_tooth(gear).half_angle(tip),
          2.0 * inner * (pi / gear.circular_spline.teeth - circular_spline_space(gear).half_angle(inner))};
}

std::optional<Failure> find_flank_contradiction(const Gear& gear) {
  if (auto failure = find_in_basics(gear))
    return failure;
  const Flexspline& f = gear.flexspline;
  const CircularSpline& c = gear.circular_spline;
  if (!(f.root_radius_mm < f.tip_radius_mm))
    return contradiction("flexspline.root_radius_mm {} must be less than flexspline.tip_radius_mm {}",
                         f.root_radius_mm, f.tip_radius_mm);
  if (!(c.tip_radius_mm < c.root_radius_mm))
    return contradiction(
        "circular_spline.tip_radius_mm {} must be less than circular_spline.root_radius_mm {} (internal "
        "teeth)",
        c.tip_radius_mm, c.root_radius_mm);
  // A tip circle ten times off the pitch circle is a slip of a unit, and the involute overflows far out
  // there.
  const double pitch = 0.5 * f.module_mm * f.teeth;
  if (!(f.tip_radius_mm < 10.0 * pitch))
    return contradiction(
        "flexspline.tip_radius_mm {} does not fit the pitch radius module_mm {} * teeth {} / 2 = {:.5g} mm",
        f.tip_radius_mm, f.module_mm, f.teeth, pitch);
  if (!(c.root_radius_mm < 10.0 * pitch))
    return contradiction("circular_spline.root_radius_mm {} does not fit the pitch radius module_mm {} * "
                         "teeth {} / 2 = {:.5g} mm",
                         c.root_radius_mm, f.module_mm, f.teeth, pitch);
  const InvoluteTooth tooth = flexspline_tooth(gear), space = circular_spline_space(gear);
  if (!(f.tip_radius_mm > tooth.base_radius))
    return Failure{
        Status::flank_outside_tooth,
        fmt::format(
            "no involute flank on the flexspline: its tip radius {} mm does not exceed the base radius "
            "{:.4f} mm",
            f.tip_radius_mm, tooth.base_radius)};
  if (!(c.root_radius_mm > space.base_radius))
    return Failure{
        Status::flank_outside_tooth,
        fmt::format(
            "no involute flank on the circular spline: its root radius {} mm does not exceed the base "
            "radius {:.4f} mm",
            c.root_radius_mm, space.base_radius)};
  const ToothThickness thickness = tooth_thickness(gear);
  if (!(thickness.flexspline_tip_mm > 0.0))
    return contradiction(
        "the flexspline tooth ends in a point below its tip circle: tip thickness {:.4g} mm at "
        "tip_radius_mm {} with profile_shift {} (pitch radius module_mm {} * teeth {} / 2 = {:.5g} mm)",
        thickness.flexspline_tip_mm, f.tip_radius_mm, f.profile_shift, f.module_mm, f.teeth, pitch);
  if (!(thickness.circular_spline_tip_mm > 0.0))
    return contradiction(
        "the circular-spline tooth ends in a point outside its tip circle: tip thickness {:.4g} mm at "
        "tip_radius_mm {} with profile_shift {}",
        thickness.circular_spline_tip_mm, c.tip_radius_mm, c.profile_shift);
  if (const double gap = pi / f.teeth - tooth.half_angle(f.root_radius_mm); !(gap > 0.0))
    return contradiction(
        "neighbouring flexspline teeth overlap at root_radius_mm {}: the space there is {:.4g} mm wide",
        f.root_radius_mm, 2.0 * gap * f.root_radius_mm);
  if (const double width = space.half_angle(c.root_radius_mm); !(width > 0.0))
    return contradiction(
        "the circular-spline space closes before its root_radius_mm {}: it is {:.4g} mm wide there",
        c.root_radius_mm, 2.0 * width * c.root_radius_mm);
  const auto& [on_flexspline, on_circular_spline] = gear.flank_modification;
  if (auto failure = find_added_material(on_flexspline, Member::flexspline, f.face_width_mm))
    return failure;
  return find_added_material(on_circular_spline, Member::circular_spline, f.face_width_mm);
}

namespace {

std::optional<Failure> find_in_cup(const Gear& gear) {
  const Flexspline& f = gear.flexspline;
  for (const auto& [name, value] : {std::pair{"rim_thickness_mm", f.rim_thickness_mm},
                                    {"wall_thickness_mm", f.wall_thickness_mm},
                                    {"cup_length_mm", f.cup_length_mm},
                                    {"face_width_mm", f.face_width_mm},
                                    {"diaphragm_thickness_mm", f.diaphragm_thickness_mm},
                                    {"boss_radius_mm", f.boss_radius_mm}})
    if (!(value > 0.0) || !std::isfinite(value))
      return contradiction("flexspline.{} {} is not a positive length", name, value);
  if (!(f.front_clearance_mm >= 0.0))
    return contradiction("flexspline.front_clearance_mm {} must not be negative", f.front_clearance_mm);
  const double outside = f.neutral_radius_mm + 0.5 * f.rim_thickness_mm;
  if (!(std::abs(f.root_radius_mm - outside) < 1e-6))
    return contradiction(
        "flexspline.root_radius_mm {} is the rim's outer surface and must equal neutral_radius_mm {} + "
        "rim_thickness_mm {} / 2 = {}",
        f.root_radius_mm, f.neutral_radius_mm, f.rim_thickness_mm, outside);
  const double inside = f.neutral_radius_mm - 0.5 * f.rim_thickness_mm;
  if (!(f.boss_radius_mm < inside))
    return contradiction("flexspline.boss_radius_mm {} must be less than the cup's inner radius {}",
                         f.boss_radius_mm, inside);
  const double behind = f.cup_length_mm - f.front_clearance_mm - f.face_width_mm;
  if (!(behind > 0.5 * f.diaphragm_thickness_mm))
    return contradiction(
        "the toothed face does not fit in the cup: cup_length_mm {} - front_clearance_mm {} - "
        "face_width_mm {} = {} leaves no wall before the diaphragm's surface at {}",
        f.cup_length_mm, f.front_clearance_mm, f.face_width_mm, behind, 0.5 * f.diaphragm_thickness_mm);
  return std::nullopt;
}

std::optional<Failure> find_in_wave_generator(const Gear& gear) {
  const Flexspline& f = gear.flexspline;
  const double front = f.cup_length_mm - f.front_clearance_mm;
  if (const auto& z = gear.contact.reference_section_mm; z && !(*z >= front - f.face_width_mm && *z <= front))
    return contradiction("contact.reference_section_mm {} must lie on the toothed face, from {} to {} mm", *z,
                         front - f.face_width_mm, front);
  const double reach = f.tip_radius_mm + gear.wave_generator.max_radial_deformation_mm;
  if (gear.wave_generator.shape != WaveGeneratorShape::table && reach >= gear.circular_spline.root_radius_mm)
    return contradiction(
        "the flexspline's teeth reach the ground of the circular spline's spaces at the major axis: "
        "flexspline.tip_radius_mm {} + max_radial_deformation_mm {} = {} mm against "
        "circular_spline.root_radius_mm {} mm",
        f.tip_radius_mm, gear.wave_generator.max_radial_deformation_mm, reach,
        gear.circular_spline.root_radius_mm);
  const double width = gear.wave_generator.contact_width_mm;
  if (!(width > 0.0))
    return contradiction("wave_generator.contact_width_mm {} is not a positive length", width);
  const double overhang = 0.5 * (width - f.face_width_mm);
  if (overhang > f.front_clearance_mm)
    return contradiction(
        "wave_generator.contact_width_mm {}, centred on face_width_mm {}, reaches {} mm past the open end "
        "of the cup",
        width, f.face_width_mm, overhang - f.front_clearance_mm);
  const double rear = f.cup_length_mm - f.front_clearance_mm - 0.5 * f.face_width_mm - 0.5 * width;
  if (!(rear > 0.5 * f.diaphragm_thickness_mm))
    return contradiction(
        "wave_generator.contact_width_mm {}, centred on the face, reaches into the diaphragm (its rear edge "
        "stands at {} mm)",
        width, rear);
  return std::nullopt;
}

} // namespace

std::optional<Failure> find_contradiction(const Gear& gear) {
  if (auto failure = find_flank_contradiction(gear))
    return failure;
  if (auto failure = find_in_cup(gear))
    return failure;
  return find_in_wave_generator(gear);
}

} // namespace strainwave
