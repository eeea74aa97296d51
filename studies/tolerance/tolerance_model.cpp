#include "studies/tolerance/tolerance_model.hpp"

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

Outcome<ToleranceModel> ToleranceModel::make(const Gear& gear, const NeutralCurve& curve,
                                             std::vector<ToleranceSource> sources) {
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
  model.sources_ = std::move(sources);
  for (ToleranceSource& source : model.sources_) {
    if (source.kind == ToleranceKind::centre_offset || source.kind == ToleranceKind::ovality)
      source.member = Member::circular_spline;
    model.first_.push_back(model.dimensions_);
    model.dimensions_ += tolerance_dimensions(source, z1, z2);
  }
  // Tooth i of angle 2 pi i/z1 in (−90°, 270°]: the first lobe up to 90°, then the second.
  const int first = -((z1 - 1) / 4);
  for (int i = first; i < first + z1; ++i) {
    Slot slot;
    slot.phi_rad = 2.0 * std::numbers::pi * i / z1;
    slot.index = i;
    slot.lobe = 4 * i > z1 ? 1 : 0;
    const double folded = slot.phi_rad - slot.lobe * std::numbers::pi;
    slot.place.pose = curve.pose_derivatives(folded);
    slot.place.space_angle_rad = folded * z1 / z2;
    slot.nominal = pair->drive(slot.place.pose.value, slot.place.space_angle_rad);
    if (!slot.nominal.overlap)
      continue;
    model.differentiate(slot, *pair);
    model.slots_.push_back(slot);
  }
  if (model.slots_.empty())
    return Failure{Status::no_overlap, "no tooth's flanks share a radius with its space"};
  return model;
}

void ToleranceModel::differentiate(Slot& slot, const FlankPair& pair) const {
  const double step_rad = step_mm / mesh_.flexspline_pitch_mm;
  const auto difference = [&](const ToothMotion& motion, double step, double& backlash_by,
                              double& radius_by) {
    const ToothMotion back{-motion.radial_mm, -motion.tangential_mm, -motion.rotation_rad};
    const auto up = pair.drive(moved(slot.place.pose.value, motion), slot.place.space_angle_rad);
    const auto down = pair.drive(moved(slot.place.pose.value, back), slot.place.space_angle_rad);
    if (!up.overlap || !down.overlap)
      return; // a tooth that only just overlaps: left at its nominal value
    backlash_by = (up.backlash_mm - down.backlash_mm) / (2.0 * step);
    radius_by = (up.contact_radius_mm - down.contact_radius_mm) / (2.0 * step);
  };
  difference({step_mm, 0.0, 0.0}, step_mm, slot.backlash_by.radial_mm, slot.radius_by.radial_mm);
  difference({0.0, step_mm, 0.0}, step_mm, slot.backlash_by.tangential_mm, slot.radius_by.tangential_mm);
  difference({0.0, 0.0, step_rad}, step_rad, slot.backlash_by.rotation_rad, slot.radius_by.rotation_rad);
}

MeshPlace ToleranceModel::place(std::size_t i, int position) const {
  const Slot& slot = slots_[i];
  MeshPlace place = slot.place;
  const int half =
      (mesh_.circular_spline_teeth - mesh_.flexspline_teeth) / 2; // see physics: pi + (phi − pi) z1/z2
  place.flexspline_tooth = wrapped(slot.index + position, mesh_.flexspline_teeth);
  place.space = wrapped(slot.index + position + slot.lobe * half, mesh_.circular_spline_teeth);
  return place;
}

void ToleranceModel::backlash(std::span<const double> values, int position, std::span<double> backlash_mm,
                              std::span<double> contact_radius_mm) const {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    const MeshPlace at = place(i, position);
    ToothMotion motion;
    double noise = 0.0;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const auto own = values.subspan(first_[s]);
      if (sources_[s].kind == ToleranceKind::backlash_noise)
        noise += own[static_cast<std::size_t>(at.flexspline_tooth)];
      else
        motion += error_motion(sources_[s], own, at, mesh_);
    }
    const auto along = [&](const ToothMotion& by) {
      return by.radial_mm * motion.radial_mm + by.tangential_mm * motion.tangential_mm +
             by.rotation_rad * motion.rotation_rad;
    };
    backlash_mm[i] = slot.nominal.backlash_mm + along(slot.backlash_by) + noise;
    contact_radius_mm[i] = slot.nominal.contact_radius_mm + along(slot.radius_by);
  }
}

} // namespace strainwave
