#pragma once
// The gear's continuous numbers that the backlash depends on, for any scalar, addressed by gear-file path.
// Internal.

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/tooth/flank_gap.hpp"

namespace strainwave {

/// One member's modification, in the file's units.
template <class T>
struct ModificationNumbers {
  T tip_relief_um, tip_relief_start, tip_relief_power, root_relief_um, root_relief_start, crowning_um,
      slope_um;
  T lead_crowning_um, lead_taper_um, end_relief_um, end_relief_length_mm;
  std::vector<T> spline_um;
  bool wanted = false; ///< a derivative with respect to one of these is asked for
};

template <class T>
struct GearNumbers {
  T module_mm, pressure_angle_deg, flexspline_shift, flexspline_tip, flexspline_root, neutral_radius,
      face_width;
  T circular_spline_shift, circular_spline_tip, circular_spline_root;
  T u0, shape_number;
  ModificationNumbers<T> on_flexspline, on_circular_spline;
};

/// f(path, number) for every plain number, in the order of the gear file; knots and the shape's number are
/// treated apart.
template <class T, class Function>
void for_each_modification_number(ModificationNumbers<T>& m, const Function& f) {
  f("tip_relief_um", m.tip_relief_um);
  f("tip_relief_start", m.tip_relief_start);
  f("tip_relief_power", m.tip_relief_power);
  f("root_relief_um", m.root_relief_um);
  f("root_relief_start", m.root_relief_start);
  f("crowning_um", m.crowning_um);
  f("slope_um", m.slope_um);
  f("lead_crowning_um", m.lead_crowning_um);
  f("lead_taper_um", m.lead_taper_um);
  f("end_relief_um", m.end_relief_um);
  f("end_relief_length_mm", m.end_relief_length_mm);
}

template <class T, class Function>
void for_each_tooth_number(GearNumbers<T>& g, const Function& f) {
  f("flexspline.module_mm", g.module_mm);
  f("flexspline.pressure_angle_deg", g.pressure_angle_deg);
  f("flexspline.profile_shift", g.flexspline_shift);
  f("flexspline.tip_radius_mm", g.flexspline_tip);
  f("flexspline.root_radius_mm", g.flexspline_root);
  f("flexspline.neutral_radius_mm", g.neutral_radius);
  f("flexspline.face_width_mm", g.face_width);
  f("circular_spline.profile_shift", g.circular_spline_shift);
  f("circular_spline.tip_radius_mm", g.circular_spline_tip);
  f("circular_spline.root_radius_mm", g.circular_spline_root);
}

template <class T>
ModificationNumbers<T> modification_numbers(const FlankModification& m) {
  ModificationNumbers<T> n;
  n.tip_relief_um = T(m.tip_relief_um);
  n.tip_relief_start = T(m.tip_relief_start);
  n.tip_relief_power = T(m.tip_relief_power);
  n.root_relief_um = T(m.root_relief_um);
  n.root_relief_start = T(m.root_relief_start);
  n.crowning_um = T(m.crowning_um);
  n.slope_um = T(m.slope_um);
  n.lead_crowning_um = T(m.lead_crowning_um);
  n.lead_taper_um = T(m.lead_taper_um);
  n.end_relief_um = T(m.end_relief_um);
  n.end_relief_length_mm = T(m.end_relief_length_mm);
  for (double value : m.spline_um)
    n.spline_um.push_back(T(value));
  return n;
}

template <class T>
GearNumbers<T> gear_numbers(const Gear& gear) {
  const Flexspline& f = gear.flexspline;
  const CircularSpline& c = gear.circular_spline;
  GearNumbers<T> n;
  n.module_mm = T(f.module_mm);
  n.pressure_angle_deg = T(f.pressure_angle_deg);
  n.flexspline_shift = T(f.profile_shift);
  n.flexspline_tip = T(f.tip_radius_mm);
  n.flexspline_root = T(f.root_radius_mm);
  n.neutral_radius = T(f.neutral_radius_mm);
  n.face_width = T(f.face_width_mm);
  n.circular_spline_shift = T(c.profile_shift);
  n.circular_spline_tip = T(c.tip_radius_mm);
  n.circular_spline_root = T(c.root_radius_mm);
  n.u0 = T(gear.wave_generator.max_radial_deformation_mm);
  n.shape_number = T(0.0); // only its derivatives are used
  n.on_flexspline = modification_numbers<T>(gear.flank_modification.flexspline);
  n.on_circular_spline = modification_numbers<T>(gear.flank_modification.circular_spline);
  return n;
}

template <class T>
RemovalLaw<T> removal_law(const ModificationNumbers<T>& m, Member member, double zeta, const T& face_width) {
  using units::mm_per_um;
  RemovalLaw<T> law;
  law.on_tip_side_down = member == Member::circular_spline;
  law.tip_relief = m.tip_relief_um * mm_per_um;
  law.tip_start = m.tip_relief_start;
  law.tip_power = m.tip_relief_power;
  law.root_relief = m.root_relief_um * mm_per_um;
  law.root_start = m.root_relief_start;
  law.crowning = m.crowning_um * mm_per_um;
  law.slope = m.slope_um * mm_per_um;
  law.lead_crowning = m.lead_crowning_um * mm_per_um;
  law.lead_taper = m.lead_taper_um * mm_per_um;
  law.end_relief = m.end_relief_um * mm_per_um;
  law.end_length = m.end_relief_length_mm;
  law.zeta = zeta;
  law.face_width = face_width;
  for (const T& value : m.spline_um)
    law.knots.push_back(T(value * mm_per_um));
  law.absent = !m.wanted && value_of(m.tip_relief_um) == 0.0 && value_of(m.root_relief_um) == 0.0 &&
               value_of(m.crowning_um) == 0.0 && value_of(m.slope_um) == 0.0 && m.spline_um.empty();
  law.prepare();
  return law;
}

template <class T>
ToothPair<T> tooth_pair(const GearNumbers<T>& g, int flexspline_teeth, int circular_spline_teeth,
                        double zeta) {
  const T alpha = g.pressure_angle_deg * (std::numbers::pi / 180.0);
  ToothPair<T> pair;
  pair.flexspline.set(T(g.module_mm * (0.5 * flexspline_teeth)), alpha, g.flexspline_shift, flexspline_teeth,
                      g.flexspline_root, g.flexspline_tip);
  pair.circular_spline.set(T(g.module_mm * (0.5 * circular_spline_teeth)), alpha, g.circular_spline_shift,
                           circular_spline_teeth, g.circular_spline_tip, g.circular_spline_root);
  pair.flexspline.removal = removal_law(g.on_flexspline, Member::flexspline, zeta, g.face_width);
  pair.circular_spline.removal =
      removal_law(g.on_circular_spline, Member::circular_spline, zeta, g.face_width);
  // At a base circle inside the flank, removal would fold the tooth's flank back on itself (r_b t < m): it
  // starts beyond.
  Flank<T>& tooth = pair.flexspline;
  if (value_of(tooth.base) * value_of(tooth.t_inner) < value_of(tooth.removed(tooth.t_inner).depth))
    tooth.t_inner = newton(tooth.t_inner, [&](const T& t) {
      const Removed<T> m = tooth.removed(t);
      return T(T(tooth.base * t - m.depth) / T(tooth.base - m.slope));
    });
  return pair;
}

} // namespace strainwave
