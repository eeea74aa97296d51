#include "studies/tolerance/tolerance_model.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace strainwave {

namespace {

int wrapped(int i, int n) {
  const int rest = i % n;
  return rest < 0 ? rest + n : rest;
}

/// 0.01 µm: the geometry is exact to rounding, so differences err by some 1e-8 of the derivative.
constexpr double step_mm = 1e-5;

} // namespace

Pose moved(const Pose& pose, const ToothMotion& motion) {
  const double turn = motion.tangential_mm / pose.rho_mm;
  return {pose.rho_mm + motion.radial_mm, pose.phi1_rad + turn,
          pose.normal_rotation_rad + motion.rotation_rad - turn};
}

namespace {

/// Derivatives of one tooth's backlash and contact radius by its motion, by central differences of the direct
/// geometry.
void differentiate(const MeshPlace& place, const FlankPair& pair, double step_rad, ToothMotion& backlash_by,
                   ToothMotion& radius_by) {
  const auto difference = [&](const ToothMotion& motion, double step, double& of_backlash,
                              double& of_radius) {
    const ToothMotion back{-motion.radial_mm, -motion.tangential_mm, -motion.rotation_rad};
    const auto up = pair.drive(moved(place.pose.value, motion), place.space_angle_rad);
    const auto down = pair.drive(moved(place.pose.value, back), place.space_angle_rad);
    if (!up.overlap || !down.overlap)
      return; // a tooth that only just overlaps: left at its nominal value
    of_backlash = (up.backlash_mm - down.backlash_mm) / (2.0 * step);
    of_radius = (up.contact_radius_mm - down.contact_radius_mm) / (2.0 * step);
  };
  difference({step_mm, 0.0, 0.0}, step_mm, backlash_by.radial_mm, radius_by.radial_mm);
  difference({0.0, step_mm, 0.0}, step_mm, backlash_by.tangential_mm, radius_by.tangential_mm);
  difference({0.0, 0.0, step_rad}, step_rad, backlash_by.rotation_rad, radius_by.rotation_rad);
}

double along(const ToothMotion& by, const ToothMotion& motion) {
  return by.radial_mm * motion.radial_mm + by.tangential_mm * motion.tangential_mm +
         by.rotation_rad * motion.rotation_rad;
}

} // namespace

Outcome<ToleranceModel> ToleranceModel::make(const Gear& gear, const NeutralCurve& curve,
                                             const std::vector<ToleranceSource>& sources) {
  const int z1 = gear.flexspline.teeth, z2 = gear.circular_spline.teeth;
  if ((z2 - z1) % 2 != 0)
    return Failure{
        Status::contradiction,
        fmt::format("{} and {} teeth differ by an odd number: the second lobe meets no space", z1, z2)};
  const auto pair = FlankPair::make(gear);
  if (!pair)
    return pair.failure();
  ToleranceModel model;
  model.mesh_ = {z1, z2, 0.5 * gear.flexspline.module_mm * z1, 0.5 * gear.flexspline.module_mm * z2,
                 gear.flexspline.neutral_radius_mm};
  // Tooth i of angle 2 pi i/z1 in (-90, 270] degrees: the first lobe up to 90, then the second.
  std::vector<ToothMotion> backlash_by, radius_by;
  const int first = -((z1 - 1) / 4);
  for (int i = first; i < first + z1; ++i) {
    const int lobe = 4 * i > z1 ? 1 : 0;
    Slot slot;
    slot.phi_rad = 2.0 * std::numbers::pi * i / z1;
    slot.flexspline_tooth = wrapped(i, z1);
    slot.space = wrapped(i + lobe * (z2 - z1) / 2, z2); // at pi + (phi - pi) z1/z2 on the second lobe
    const double folded = slot.phi_rad - lobe * std::numbers::pi;
    slot.place.pose = curve.pose_derivatives(folded);
    slot.place.space_angle_rad = folded * z1 / z2;
    slot.nominal = pair->drive(slot.place.pose.value, slot.place.space_angle_rad);
    if (!slot.nominal.overlap)
      continue;
    differentiate(slot.place, *pair, step_mm / model.mesh_.flexspline_pitch_mm, backlash_by.emplace_back(),
                  radius_by.emplace_back());
    model.slots_.push_back(slot);
  }
  if (model.slots_.empty())
    return Failure{Status::no_overlap, "no tooth's flanks share a radius with its space"};
  for (const ToleranceSource& source : sources)
    model.add_source(source, backlash_by, radius_by);
  return model;
}

void ToleranceModel::add_source(ToleranceSource wanted, const std::vector<ToothMotion>& backlash_by,
                                const std::vector<ToothMotion>& radius_by) {
  if (wanted.kind == ToleranceKind::centre_offset || wanted.kind == ToleranceKind::ovality)
    wanted.member = Member::circular_spline;
  if (wanted.kind == ToleranceKind::backlash_noise)
    wanted.member = Member::flexspline;
  Source source{wanted, dimensions_, {}, {}, {}};
  const int teeth =
      wanted.member == Member::flexspline ? mesh_.flexspline_teeth : mesh_.circular_spline_teeth;
  dimensions_ += tolerance_dimensions(wanted, mesh_.flexspline_teeth, mesh_.circular_spline_teeth);
  for (int k = 0; k < teeth; ++k) {
    const double angle = 2.0 * std::numbers::pi * k * error_order(wanted) / teeth;
    source.cosine.push_back(std::cos(angle));
    source.sine.push_back(std::sin(angle));
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const ToothMotion one = error_motion(wanted, {1.0, 0.0}, slots_[i].place, mesh_);
    const ToothMotion two = error_motion(wanted, {0.0, 1.0}, slots_[i].place, mesh_);
    Change change{along(backlash_by[i], one), along(backlash_by[i], two), along(radius_by[i], one),
                  along(radius_by[i], two)};
    if (wanted.kind == ToleranceKind::backlash_noise)
      change.backlash_first = 1.0;
    source.by_slot.push_back(change);
  }
  sources_.push_back(std::move(source));
}

MeshPlace ToleranceModel::place(std::size_t i, int position) const {
  const Slot& slot = slots_[i];
  MeshPlace place = slot.place;
  place.flexspline_tooth = wrapped(slot.flexspline_tooth + position, mesh_.flexspline_teeth);
  place.space = wrapped(slot.space + position, mesh_.circular_spline_teeth);
  return place;
}

void ToleranceModel::backlash(std::span<const double> values, int position, std::span<double> backlash_mm,
                              std::span<double> contact_radius_mm) const {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    backlash_mm[i] = slots_[i].nominal.backlash_mm;
    contact_radius_mm[i] = slots_[i].nominal.contact_radius_mm;
  }
  for (const Source& source : sources_) {
    const bool per_tooth = is_per_tooth(source.source.kind);
    const bool on_flexspline = source.source.member == Member::flexspline;
    const auto own = values.subspan(source.first);
    const ErrorAtTooth vector = error_vector(source.source, own);
    const int teeth = static_cast<int>(source.cosine.size());
    const int shift = wrapped(position, teeth);
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      int tooth = (on_flexspline ? slots_[i].flexspline_tooth : slots_[i].space) + shift;
      tooth -= tooth >= teeth ? teeth : 0;
      const auto k = static_cast<std::size_t>(tooth);
      const double c = source.cosine[k], s = source.sine[k];
      const double one = per_tooth ? own[k] : vector.first * c + vector.second * s;
      const double two = per_tooth ? 0.0 : vector.second * c - vector.first * s;
      const Change& by = source.by_slot[i];
      backlash_mm[i] += by.backlash_first * one + by.backlash_second * two;
      contact_radius_mm[i] += by.radius_first * one + by.radius_second * two;
    }
  }
}

} // namespace strainwave
