#include "strainwave/model/tolerance/tolerance_model.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/tolerance/flank_shape.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace strainwave {

namespace {

using units::pi;

int wrapped(int i, int n) {
  const int rest = i % n;
  return rest < 0 ? rest + n : rest;
}

/// 0.01 µm: the geometry is exact to rounding, so differences err by some 1e-8 of the derivative.
constexpr double step_mm = 1e-5;

double along(const ToothMotion& by, const ToothMotion& motion) {
  return by.radial_mm * motion.radial_mm + by.tangential_mm * motion.tangential_mm +
         by.rotation_rad * motion.rotation_rad;
}

ToothMotion scaled(const ToothMotion& motion, double factor) {
  return {factor * motion.radial_mm, factor * motion.tangential_mm, factor * motion.rotation_rad};
}

using Flank = ToothBacklash (FlankPair::*)(const Pose&, double) const;

/// Derivatives of one tooth's backlash and contact radius by its motion, by central differences of the direct
/// geometry.
void differentiate(const MeshPlace& place, const FlankPair& pair, Flank flank, double step_rad,
                   ToothMotion& backlash_by, ToothMotion& radius_by) {
  const auto difference = [&](const ToothMotion& motion, double step, double& of_backlash,
                              double& of_radius) {
    const auto up = (pair.*flank)(moved(place.pose.value, motion), place.space_angle_rad);
    const auto down = (pair.*flank)(moved(place.pose.value, scaled(motion, -1.0)), place.space_angle_rad);
    if (!up.overlap || !down.overlap)
      return; // a tooth that only just overlaps: left at its nominal value
    of_backlash = (up.backlash_mm - down.backlash_mm) / (2.0 * step);
    of_radius = (up.contact_radius_mm - down.contact_radius_mm) / (2.0 * step);
  };
  difference({step_mm, 0.0, 0.0}, step_mm, backlash_by.radial_mm, radius_by.radial_mm);
  difference({0.0, step_mm, 0.0}, step_mm, backlash_by.tangential_mm, radius_by.tangential_mm);
  difference({0.0, 0.0, step_rad}, step_rad, backlash_by.rotation_rad, radius_by.rotation_rad);
}

} // namespace

Pose moved(const Pose& pose, const ToothMotion& motion) {
  const double turn = motion.tangential_mm / pose.rho_mm;
  return {pose.rho_mm + motion.radial_mm, pose.phi1_rad + turn,
          pose.normal_rotation_rad + motion.rotation_rad - turn};
}

Outcome<ToleranceModel> ToleranceModel::make(const Gear& gear, const NeutralCurve& curve,
                                             const std::vector<ToleranceSource>& sources) {
  const int z1 = gear.flexspline.teeth;
  std::vector<MeshedTooth> teeth; // angle in (−90°, 270°]: the first lobe up to 90°, then the second
  const int first = -((z1 - 1) / 4);
  for (int i = first; i < first + z1; ++i) {
    const double phi = 2.0 * pi * i / z1;
    teeth.push_back({phi, i, curve.pose(phi - (4 * i > z1 ? pi : 0.0))});
  }
  return make(gear, curve, teeth, sources);
}

Outcome<ToleranceModel> ToleranceModel::make(const Gear& gear, const NeutralCurve& curve,
                                             const std::vector<MeshedTooth>& teeth,
                                             const std::vector<ToleranceSource>& sources) {
  auto made = of_teeth(gear, curve, teeth);
  if (!made)
    return made;
  ToleranceModel model = std::move(made).value();
  for (const ToleranceSource& source : sources) {
    if (auto failure = model.add_source(gear, source))
      return *failure;
  }
  return model;
}

Outcome<ToleranceModel> ToleranceModel::of_teeth(const Gear& gear, const NeutralCurve& curve,
                                                 const std::vector<MeshedTooth>& teeth) {
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
  const double step_rad = step_mm / model.mesh_.flexspline_pitch_mm;
  for (const MeshedTooth& tooth : teeth) {
    const int lobe = 4 * tooth.tooth > z1 ? 1 : 0;
    Slot slot;
    slot.phi_rad = tooth.phi_rad;
    slot.flexspline_tooth = wrapped(tooth.tooth, z1);
    slot.space =
        wrapped(tooth.tooth + lobe * (z2 - z1) / 2, z2); // at pi + (phi - pi) z1/z2 on the second lobe
    const double folded = slot.phi_rad - lobe * pi;
    slot.place.pose = curve.pose_derivatives(folded);
    slot.place.pose.value = tooth.pose;
    slot.place.space_angle_rad = folded * z1 / z2;
    slot.nominal = pair->drive(tooth.pose, slot.place.space_angle_rad);
    if (!slot.nominal.overlap)
      continue;
    differentiate(slot.place, *pair, &FlankPair::drive, step_rad, slot.backlash_by, slot.radius_by);
    const ToothBacklash coast = pair->coast(tooth.pose, slot.place.space_angle_rad);
    slot.coast_mm = coast.overlap ? coast.backlash_mm : std::numeric_limits<double>::infinity();
    ToothMotion unused;
    if (coast.overlap)
      differentiate(slot.place, *pair, &FlankPair::coast, step_rad, slot.coast_by, unused);
    model.slots_.push_back(slot);
  }
  if (model.slots_.empty())
    return Failure{Status::no_overlap, "no tooth's flanks share a radius with its space"};
  return model;
}

double ToleranceModel::backlash_by(std::size_t i, const ToothMotion& motion) const {
  return along(slots_[i].backlash_by, motion);
}
double ToleranceModel::radius_by(std::size_t i, const ToothMotion& motion) const {
  return along(slots_[i].radius_by, motion);
}
double ToleranceModel::coast_by(std::size_t i, const ToothMotion& motion) const {
  return along(slots_[i].coast_by, motion);
}

std::optional<Failure> ToleranceModel::add_source(const Gear& gear, ToleranceSource wanted) {
  if (wanted.kind == ToleranceKind::centre_offset || wanted.kind == ToleranceKind::ovality)
    wanted.member = Member::circular_spline;
  if (wanted.kind == ToleranceKind::backlash_noise)
    wanted.member = Member::flexspline;
  Source source;
  source.source = wanted;
  source.first = dimensions_;
  const int teeth =
      wanted.member == Member::flexspline ? mesh_.flexspline_teeth : mesh_.circular_spline_teeth;
  for (int k = 0; k < teeth; ++k) {
    const double angle = 2.0 * pi * k * error_order(wanted) / teeth;
    source.cosine.push_back(std::cos(angle));
    source.sine.push_back(std::sin(angle));
  }
  if (is_of_shape(wanted.kind)) {
    if (auto failure = add_shape(gear, source))
      return failure;
  } else {
    add_motion(source);
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const auto change = [&](const ToothErrors& e) {
      return std::array{e.backlash_mm + backlash_by(i, e.motion), e.radius_mm + radius_by(i, e.motion),
                        e.coast_backlash_mm + coast_by(i, e.motion)};
    };
    const auto one = change(source.error_first[i]), two = change(source.error_second[i]);
    source.backlash.push_back({one[0], two[0]});
    source.radius.push_back({one[1], two[1]});
    source.coast.push_back({one[2], two[2]});
  }
  dimensions_ += tolerance_dimensions(wanted, mesh_.flexspline_teeth, mesh_.circular_spline_teeth);
  sources_.push_back(std::move(source));
  return std::nullopt;
}

void ToleranceModel::add_motion(Source& source) {
  const double unit = source.source.unit_mm;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    ToothErrors one, two;
    one.motion = scaled(error_motion(source.source, {1.0, 0.0}, slots_[i].place, mesh_), unit);
    two.motion = scaled(error_motion(source.source, {0.0, 1.0}, slots_[i].place, mesh_), unit);
    if (source.source.kind == ToleranceKind::backlash_noise)
      one.backlash_mm = unit;
    // A thicker tooth meets its coast flank from the other side: the motion's part, once more, backwards.
    if (source.source.kind == ToleranceKind::tooth_thickness)
      one.coast_backlash_mm = -2.0 * coast_by(i, one.motion);
    source.error_first.push_back(one);
    source.error_second.push_back(two);
  }
}

std::optional<Failure> ToleranceModel::add_shape(const Gear& gear, Source& source) {
  const auto shapes = shape_pair(gear, source.source);
  if (!shapes)
    return shapes.failure();
  const bool key = source.source.kind == ToleranceKind::gear_key;
  if (key)
    source.zero = NumberPath(source.source.path).get(gear);
  const double per = (key ? 1.0 : source.source.unit_mm) / (2.0 * shapes->step);
  for (const Slot& slot : slots_) {
    ToothErrors one;
    const Pose& pose = slot.place.pose.value;
    const auto up = shapes->up.drive(pose, slot.place.space_angle_rad);
    const auto down = shapes->down.drive(pose, slot.place.space_angle_rad);
    if (up.overlap && down.overlap) {
      one.backlash_mm = per * (up.backlash_mm - down.backlash_mm);
      one.radius_mm = per * (up.contact_radius_mm - down.contact_radius_mm);
    }
    if (std::isfinite(slot.coast_mm) && source.source.kind != ToleranceKind::wear) {
      const auto coast_up = shapes->up.coast(pose, slot.place.space_angle_rad);
      const auto coast_down = shapes->down.coast(pose, slot.place.space_angle_rad);
      if (coast_up.overlap && coast_down.overlap)
        one.coast_backlash_mm = per * (coast_up.backlash_mm - coast_down.backlash_mm);
    }
    source.error_first.push_back(one);
    source.error_second.emplace_back();
  }
  return std::nullopt;
}

MeshPlace ToleranceModel::place(std::size_t i, int position) const {
  const Slot& slot = slots_[i];
  MeshPlace place = slot.place;
  place.flexspline_tooth = wrapped(slot.flexspline_tooth + position, mesh_.flexspline_teeth);
  place.space = wrapped(slot.space + position, mesh_.circular_spline_teeth);
  return place;
}

/// add(source, slot, first, second) for every source and slot, with the sample's ErrorAtTooth.
template <class Add>
void ToleranceModel::each(std::span<const double> values, int position, Add&& add) const {
  for (const Source& source : sources_) {
    const auto own = values.subspan(source.first);
    const int teeth = static_cast<int>(source.cosine.size());
    const bool on_flexspline = source.source.member == Member::flexspline;
    const int shift = wrapped(position, teeth);
    const auto tooth_of = [&](std::size_t i) {
      const int tooth = (on_flexspline ? slots_[i].flexspline_tooth : slots_[i].space) + shift;
      return static_cast<std::size_t>(tooth >= teeth ? tooth - teeth : tooth);
    };
    if (is_per_tooth(source.source.kind)) {
      for (std::size_t i = 0; i < slots_.size(); ++i)
        add(source, i, own[tooth_of(i)], 0.0);
      continue;
    }
    ErrorAtTooth vector = error_vector(source.source, own);
    vector.first -= source.zero;
    if (error_order(source.source) == 0) {
      for (std::size_t i = 0; i < slots_.size(); ++i)
        add(source, i, vector.first, vector.second);
      continue;
    }
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      const std::size_t k = tooth_of(i);
      const double c = source.cosine[k], s = source.sine[k];
      add(source, i, vector.first * c + vector.second * s, vector.second * c - vector.first * s);
    }
  }
}

void ToleranceModel::backlash(std::span<const double> values, int position, std::span<double> backlash_mm,
                              std::span<double> contact_radius_mm) const {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    backlash_mm[i] = slots_[i].nominal.backlash_mm;
    contact_radius_mm[i] = slots_[i].nominal.contact_radius_mm;
  }
  each(values, position, [&](const Source& source, std::size_t i, double first, double second) {
    backlash_mm[i] += source.backlash[i].first * first + source.backlash[i].second * second;
    contact_radius_mm[i] += source.radius[i].first * first + source.radius[i].second * second;
  });
}

void ToleranceModel::backlash(std::span<const double> values, int position, std::span<double> backlash_mm,
                              std::span<double> contact_radius_mm, std::span<double> coast_mm) const {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    backlash_mm[i] = slots_[i].nominal.backlash_mm;
    contact_radius_mm[i] = slots_[i].nominal.contact_radius_mm;
    coast_mm[i] = slots_[i].coast_mm;
  }
  each(values, position, [&](const Source& source, std::size_t i, double first, double second) {
    backlash_mm[i] += source.backlash[i].first * first + source.backlash[i].second * second;
    contact_radius_mm[i] += source.radius[i].first * first + source.radius[i].second * second;
    coast_mm[i] += source.coast[i].first * first + source.coast[i].second * second;
  });
}

void ToleranceModel::errors(std::span<const double> values, int position,
                            std::span<ToothErrors> errors) const {
  for (std::size_t i = 0; i < slots_.size(); ++i)
    errors[i] = {};
  each(values, position, [&](const Source& source, std::size_t i, double first, double second) {
    const ToothErrors &one = source.error_first[i], &two = source.error_second[i];
    ToothErrors& sum = errors[i];
    sum.motion += scaled(one.motion, first);
    sum.motion += scaled(two.motion, second);
    sum.backlash_mm += one.backlash_mm * first;
    sum.radius_mm += one.radius_mm * first;
    sum.coast_backlash_mm += one.coast_backlash_mm * first;
  });
}

} // namespace strainwave
