#include "strainwave/model/export/result_file.hpp"

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/version.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <hdf5_hl.h>

#include <cerrno>
#include <system_error>

namespace strainwave {

namespace {

/// One open group; datasets are written into it with their unit.
class Group {
public:
  Group(hid_t parent, const std::string& name)
      : id_(check(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT))) {}
  ~Group() { H5Gclose(id_); }
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;
  hid_t id() const { return id_; }

  void put(const char* name, const char* unit, const std::vector<double>& values,
           std::vector<hsize_t> shape = {}) {
    if (shape.empty())
      shape = {values.size()};
    check(H5LTmake_dataset_double(id_, name, static_cast<int>(shape.size()), shape.data(), values.data()));
    check(H5LTset_attribute_string(id_, name, "units", unit));
  }
  void put(const char* name, const char* unit, double value) {
    check(H5LTmake_dataset_double(id_, name, 0, nullptr, &value));
    check(H5LTset_attribute_string(id_, name, "units", unit));
  }
  void put(const char* name, const std::vector<int>& values) {
    const hsize_t size = values.size();
    check(H5LTmake_dataset_int(id_, name, 1, &size, values.data()));
    check(H5LTset_attribute_string(id_, name, "units", "1"));
  }

  template <class T>
  static T check(T code) {
    if (code < 0)
      throw std::system_error(EIO, std::generic_category(), "HDF5 refused to write the result file");
    return code;
  }

private:
  hid_t id_;
};

void text(hid_t file, const char* name, std::string_view value) {
  Group::check(H5LTmake_dataset_string(file, name, std::string(value).c_str()));
}

void put_points(const PointResults& from, hid_t parent) {
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

void put_load(const LoadResult& load, Group& group) {
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
  put_points(load.points, group.id());
  if (const CoastResults& coast = load.coast; !coast.tooth.empty()) {
    Group side(group.id(), "coast_flank");
    side.put("tooth", coast.tooth);
    side.put("phi", "deg", coast.phi_deg);
    side.put("force", "N", coast.force_n);
    side.put("peak_force", "N", coast.peak_force_n);
    put_points(coast.points, side.id());
  }
  if (load.transmission_error_arcsec)
    group.put("transmission_error", "arcsec", *load.transmission_error_arcsec);
}

void put_all(const ForwardResult& result, hid_t file) {
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
      Group map(group.id(), "assembled");
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
      Group group(loads.id(), fmt::format("{:04}", i));
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

} // namespace

void write_result_file(const ForwardResult& result, const std::string& config,
                       const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // errors are reported by exception, not printed
  const auto refused = [&path](const std::error_code& cause) {
    return std::system_error(cause, fmt::format("cannot write {}", path.string()));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw refused(std::make_error_code(std::errc::is_a_directory));
  const std::filesystem::path beside = path.string() + ".part";
  errno = 0;
  const hid_t file = H5Fcreate(beside.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (file < 0)
    throw refused(std::error_code(errno != 0 ? errno : EIO, std::generic_category()));
  try {
    text(file, "config", config);
    text(file, "version", library_version);
    text(file, "status", status_name(result.status));
    text(file, "message", result.message);
    text(file, "fidelity", choice_name(result.fidelity));
    put_all(result, file);
    Group::check(H5Fflush(file, H5F_SCOPE_GLOBAL));
  } catch (const std::system_error&) {
    const int cause = errno;
    H5Fclose(file);
    std::filesystem::remove(beside, ignored);
    throw refused(std::error_code(cause != 0 ? cause : EIO, std::generic_category()));
  }
  std::error_code error;
  errno = 0;
  if (H5Fclose(file) < 0)
    error = std::error_code(errno != 0 ? errno : EIO, std::generic_category()); // a full disk shows here
  else
    std::filesystem::rename(beside, path, error);
  if (!error)
    return;
  std::filesystem::remove(beside, ignored);
  throw refused(error);
}

} // namespace strainwave
