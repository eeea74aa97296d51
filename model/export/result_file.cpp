#include "strainwave/model/export/result_file.hpp"

#include "strainwave/common/files/hdf5.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/version.hpp"

#include <fmt/format.h>

#include <limits>
#include <optional>

namespace strainwave {

namespace {

/// A group; datasets are written into it with their unit.
class Group {
public:
  explicit Group(const hdf5::Group& root) : group_(&root) {}
  Group(const Group& parent, const std::string& name)
      : own_(parent.group_->make_group(name)), group_(&*own_) {}
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  void put(const char* name, const char* unit, const std::vector<double>& values,
           const hdf5::Shape& shape) const {
    group_->put(name, values, shape).set_text("units", unit);
  }
  void put(const char* name, const char* unit, const std::vector<double>& values) const {
    put(name, unit, values, {values.size()});
  }
  void put(const char* name, const char* unit, double value) const {
    group_->put_number(name, value).set_text("units", unit);
  }
  void put(const char* name, const std::vector<int>& values) const {
    group_->put(name, values).set_text("units", "1");
  }

private:
  std::optional<hdf5::Group> own_;
  const hdf5::Group* group_;
};

void put_points(const PointResults& from, const Group& parent) {
  if (from.tooth.empty())
    return;
  Group points(parent, "points");
  points.put("tooth", from.tooth);
  points.put("flank_radius", "mm", from.flank_radius_mm);
  points.put("z", "mm", from.z_mm);
  points.put("contact_radius", "mm", from.contact_radius_mm);
  points.put("force", "N", from.force_n);
  points.put("gap", "um", from.gap_um);
  points.put("half_width", "um", from.half_width_um);
  points.put("pressure", "MPa", from.pressure_mpa);
  points.put("edge", from.edge);
}

void put_load(const LoadResult& load, const Group& group) {
  group.put("rotation", "rad", load.rotation_rad);
  group.put("torque", "N.m", load.torque_nm);
  group.put("coast", "1", load.direction == Direction::coast ? 1.0 : 0.0);
  group.put("tooth", load.tooth);
  group.put("phi", "deg", load.phi_deg);
  group.put("force", "N", load.force_n);
  group.put("loaded_backlash", "um", load.loaded_backlash_um);
  group.put("pressure", "MPa", load.pressure_mpa);
  group.put("engaged_phi", "deg", {load.engaged_lo_deg, load.engaged_hi_deg});
  group.put("peak_force", "N", load.peak_force_n);
  group.put("peak_phi", "deg", load.peak_phi_deg);
  group.put("peak_phase", "1", load.peak_phase);
  group.put("peak_pressure", "MPa", load.peak_pressure.mpa);
  group.put("peak_flank_pressure", "MPa", load.peak_flank_pressure.mpa);
  group.put("peak_pressure_phi", "deg", load.peak_pressure.phi_deg);
  group.put("peak_pressure_flank_radius", "mm", load.peak_pressure.flank_radius_mm);
  group.put("peak_pressure_z", "mm", load.peak_pressure.z_mm);
  group.put("peak_pressure_phase", "1", load.peak_pressure.phase);
  group.put("tangent_stiffness", "N.m/rad", load.tangent_stiffness_nm_per_rad);
  group.put("disc_force", "N", load.disc_force_n);
  put_points(load.points, group);
  if (const CoastResults& coast = load.coast; !coast.tooth.empty()) {
    Group side(group, "coast_flank");
    side.put("tooth", coast.tooth);
    side.put("phi", "deg", coast.phi_deg);
    side.put("force", "N", coast.force_n);
    side.put("peak_force", "N", coast.peak_force_n);
    put_points(coast.points, side);
  }
  if (load.transmission_error_arcsec)
    group.put("transmission_error", "arcsec", *load.transmission_error_arcsec);
}

void put_all(const ForwardResult& result, const Group& file) {
  if (const auto& wg = result.wave_generator) {
    Group group(file, "wave_generator");
    group.put("wrap_angle", "deg", wg->wrap_angle_deg);
    group.put("disc_radius", "mm", wg->disc_radius_mm);
    group.put("eccentricity", "mm", wg->eccentricity_mm);
    group.put("u90", "mm", wg->u90_mm);
    group.put("rim_strain", "1", wg->rim_strain);
  }
  if (const auto& b = result.backlash) {
    Group group(file, "backlash");
    group.put("tooth", b->tooth);
    group.put("phi", "deg", b->phi_deg);
    group.put("backlash", "um", b->backlash_um);
    group.put("coast_backlash", "um", b->coast_backlash_um);
    group.put("contact_radius", "mm", b->contact_radius_mm);
    group.put("min", "um", b->min_um);
    group.put("min_phi", "deg", b->min_phi_deg);
    if (const auto& a = b->assembled) {
      Group map(group, "assembled");
      map.put("z", "mm", a->z_mm);
      map.put("phi", "deg", a->phi_deg);
      std::vector<double> flat;
      for (const auto& row : a->backlash_um)
        flat.insert(flat.end(), row.begin(), row.end());
      map.put("backlash", "um", flat, {a->z_mm.size(), a->phi_deg.size()});
      map.put("min", "um", a->min_um);
      map.put("min_phi", "deg", a->min_phi_deg);
      map.put("min_z", "mm", a->min_z_mm);
    }
  }
  if (const auto& a = result.assembly) {
    Group group(file, "assembly");
    group.put("contact_force", "N", a->contact_force_n);
    group.put("contact_phi", "deg", {a->contact_lo_deg, a->contact_hi_deg});
    group.put("radial_deformation", "mm", a->radial_deformation_mm);
    group.put("disc_shift", "mm", a->disc_shift_mm);
  }
  if (const auto& c = result.compliance) {
    Group group(file, "compliance");
    group.put("tooth", c->tooth);
    std::vector<double> flat;
    for (const auto& row : c->matrix_um_per_n)
      flat.insert(flat.end(), row.begin(), row.end());
    group.put("matrix", "um/N", flat, {c->tooth.size(), c->tooth.size()});
  }
  if (!result.load.empty()) {
    Group loads(file, "load");
    for (std::size_t i = 0; i < result.load.size(); ++i) {
      Group group(loads, fmt::format("{:04}", i));
      put_load(result.load[i], group);
    }
  }
  if (const auto& w = result.wedge) {
    Group group(file, "wedge");
    group.put("phase", "1", w->phase);
    group.put("rotation", "rad", w->rotation_rad);
    group.put("overlap", "um", w->overlap_um);
    group.put("peak_force", "N", w->peak_force_n);
    group.put("sum_force", "N", w->sum_force_n);
    group.put("drive_count", "1", w->drive_count);
    group.put("coast_count", "1", w->coast_count);
  }
  if (const auto& s = result.stiffness) {
    Group group(file, "stiffness");
    group.put("secant", "N.m/rad", s->secant_nm_per_rad);
    group.put("lost_motion", "arcmin", s->lost_motion_arcmin);
    group.put("take_up", "rad", s->take_up_rad);
    group.put("wind_up", "rad", s->wind_up_rad);
  }
  if (const auto& c = result.certificate) {
    Group group(file, "certificate");
    group.put("complementarity", "1", c->complementarity);
    group.put("min_gap", "um", c->min_gap_um);
    group.put("min_force", "N", c->min_force_n);
    group.put("reciprocity", "1", c->reciprocity);
    group.put("equilibrium", "1", c->equilibrium);
    group.put("exact_gap_residual", "um", c->exact_gap_residual_um);
    group.put("rounding", "um", c->rounding_um);
    group.put("discretisation_estimate", "1", c->discretisation_estimate);
  }
}

void put_path(const LoadPath& path, const Group& group) {
  group.put("phase", "1", path.phase);
  group.put("start_rotation", "rad", path.start_rotation_rad);
  group.put("start_torque", "N.m", path.start_torque_nm);
  group.put("start_stiffness", "N.m/rad", path.start_stiffness_nm_per_rad);
  group.put("end_rotation", "rad", path.end_rotation_rad);
  group.put("end_torque", "N.m", path.end_torque_nm);
  std::vector<double> rotation, torque, stiffness, phi, height, z;
  std::vector<int> wall_joins, wall_leaves, event_of, tooth, coast, joins, whole_tooth;
  for (std::size_t k = 0; k < path.events.size(); ++k) {
    const LoadPathEvent& event = path.events[k];
    rotation.push_back(event.rotation_rad);
    torque.push_back(event.torque_nm);
    stiffness.push_back(event.stiffness_nm_per_rad);
    wall_joins.push_back(event.wall_joins);
    wall_leaves.push_back(event.wall_leaves);
    for (const LoadPathChange& change : event.changes) {
      event_of.push_back(static_cast<int>(k));
      tooth.push_back(change.point.tooth);
      phi.push_back(change.point.phi_deg);
      coast.push_back(change.point.coast);
      height.push_back(change.point.flank_radius_mm);
      z.push_back(change.point.z_mm);
      joins.push_back(change.joins);
      whole_tooth.push_back(change.whole_tooth);
    }
  }
  const Group events(group, "events");
  events.put("rotation", "rad", rotation);
  events.put("torque", "N.m", torque);
  events.put("stiffness", "N.m/rad", stiffness);
  events.put("wall_joins", wall_joins);
  events.put("wall_leaves", wall_leaves);
  const Group changes(group, "changes");
  changes.put("event", event_of);
  changes.put("tooth", tooth);
  changes.put("phi", "deg", phi);
  changes.put("coast", coast);
  changes.put("flank_radius", "mm", height);
  changes.put("z", "mm", z);
  changes.put("joins", joins);
  changes.put("whole_tooth", whole_tooth);
  std::vector<double> at_torque, at_rotation, direct, exact_rad, exact_nm;
  for (const LoadOnPath& load : path.loads) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    at_torque.push_back(load.torque_nm);
    at_rotation.push_back(load.rotation_rad);
    direct.push_back(load.direct_difference);
    exact_rad.push_back(load.exact_minus_path_rad.value_or(none));
    exact_nm.push_back(load.exact_minus_path_nm.value_or(none));
  }
  const Group loads(group, "loads");
  loads.put("torque", "N.m", at_torque);
  loads.put("rotation", "rad", at_rotation);
  loads.put("direct_difference", "1", direct);
  loads.put("exact_minus_path_rotation", "rad", exact_rad);
  loads.put("exact_minus_path_torque", "N.m", exact_nm);
}

} // namespace

void write_result_file(const ForwardResult& result, const std::string& config,
                       const std::filesystem::path& path, const LoadPath* load_path) {
  hdf5::write_file(path, {"strainwave result", 1}, [&](const hdf5::Group& root) {
    root.put_text("config", config);
    root.put_text("version", library_version);
    root.put_text("status", status_name(result.status));
    root.put_text("message", result.message);
    root.put_text("fidelity", choice_name(result.fidelity));
    const Group file(root);
    put_all(result, file);
    if (load_path)
      put_path(*load_path, Group(file, "path"));
  });
}

} // namespace strainwave
