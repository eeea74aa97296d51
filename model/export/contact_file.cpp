#include "strainwave/model/export/contact_file.hpp"

#include "strainwave/common/files/replaced_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <hdf5_hl.h>

#include <cerrno>
#include <functional>

namespace strainwave {

namespace {

struct Refused {};

void check(herr_t code) {
  if (code < 0)
    throw Refused{};
}

void put(hid_t group, const char* name, const char* unit, const std::vector<double>& values,
         std::vector<hsize_t> shape = {}) {
  if (shape.empty())
    shape = {values.size()};
  check(H5LTmake_dataset_double(group, name, static_cast<int>(shape.size()), shape.data(), values.data()));
  check(H5LTset_attribute_string(group, name, "units", unit));
}

std::vector<double> of(const std::vector<LoadedPoint>& points,
                       const std::function<double(const LoadedPoint&)>& read) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const LoadedPoint& point : points)
    values.push_back(read(point));
  return values;
}

void put_phase(hid_t group, const PhaseProblem& phase) {
  const ContactProblem& problem = phase.load.problem;
  const auto size = static_cast<hsize_t>(problem.q.size());
  const auto all = [](const auto& matrix) {
    return std::vector<double>(matrix.data(), matrix.data() + matrix.size());
  };
  put(group, "compliance", "mm/N", all(problem.m),
      {size, size}); // symmetric: the order of storage does not show
  put(group, "gap", "mm", all(problem.q));
  put(group, "lever", "mm", all(problem.r));
  const std::vector<LoadedPoint>& points = phase.points;
  put(group, "tooth", "1", of(points, [](const LoadedPoint& p) { return static_cast<double>(p.tooth); }));
  put(group, "flank_radius", "mm", of(points, [](const LoadedPoint& p) { return p.flank_radius_mm; }));
  put(group, "z", "mm", of(points, [](const LoadedPoint& p) { return p.z_mm; }));
  put(group, "contact_radius", "mm", of(points, [](const LoadedPoint& p) { return p.contact_radius_mm; }));
  put(group, "backlash", "mm", of(points, [](const LoadedPoint& p) { return p.backlash_mm; }));
  put(group, "pressure_angle", "rad", of(points, [](const LoadedPoint& p) { return p.pressure_angle_rad; }));
  put(group, "phase", "1", {phase.phase}, {1});
  put(group, "lobes", "1", {phase.load.lobes}, {1});
}

} // namespace

void write_contact_file(std::span<const PhaseProblem> phases, const std::string& config,
                        const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // errors are reported by exception, not printed
  if (std::filesystem::is_directory(path))
    cannot_write(path, EISDIR);
  const std::filesystem::path beside = path.string() + ".part";
  errno = 0;
  const hid_t file = H5Fcreate(beside.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (file < 0)
    cannot_write(path, errno);
  std::error_code ignored, error;
  try {
    check(H5LTmake_dataset_string(file, "config", config.c_str()));
    for (std::size_t k = 0; k < phases.size(); ++k) {
      const hid_t group =
          H5Gcreate2(file, fmt::format("phase_{}", k).c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      if (group < 0)
        throw Refused{};
      try {
        put_phase(group, phases[k]);
      } catch (const Refused&) {
        H5Gclose(group);
        throw;
      }
      H5Gclose(group);
    }
    check(H5Fflush(file, H5F_SCOPE_GLOBAL));
  } catch (const Refused&) {
    const int cause = errno;
    H5Fclose(file);
    std::filesystem::remove(beside, ignored);
    cannot_write(path, cause);
  }
  errno = 0;
  if (H5Fclose(file) < 0) { // a full disk shows here
    const int cause = errno;
    std::filesystem::remove(beside, ignored);
    cannot_write(path, cause);
  }
  std::filesystem::rename(beside, path, error);
  if (error) {
    std::filesystem::remove(beside, ignored);
    cannot_write(path, error.value());
  }
}

} // namespace strainwave
