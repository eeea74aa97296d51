#include "strainwave/model/export/contact_file.hpp"

#include "strainwave/common/files/hdf5.hpp"

#include <fmt/format.h>

#include <functional>

namespace strainwave {

namespace {

void put(const hdf5::Group& group, const char* name, const char* unit, const std::vector<double>& values,
         const hdf5::Shape& shape) {
  group.put(name, values, shape).set_text("units", unit);
}

void put(const hdf5::Group& group, const char* name, const char* unit, const std::vector<double>& values) {
  put(group, name, unit, values, {values.size()});
}

std::vector<double> of(const std::vector<LoadedPoint>& points,
                       const std::function<double(const LoadedPoint&)>& read) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const LoadedPoint& point : points)
    values.push_back(read(point));
  return values;
}

void put_phase(const hdf5::Group& group, const PhaseProblem& phase) {
  const ContactProblem& problem = phase.load.problem;
  const auto size = static_cast<std::size_t>(problem.q.size());
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
  put(group, "phase", "1", {phase.phase});
  put(group, "lobes", "1", {static_cast<double>(phase.load.lobes)});
}

} // namespace

void write_contact_file(std::span<const PhaseProblem> phases, const std::string& config,
                        const std::filesystem::path& path) {
  hdf5::write_file(path, {"strainwave contact", 1}, [&](const hdf5::Group& file) {
    file.put_text("config", config);
    for (std::size_t k = 0; k < phases.size(); ++k)
      put_phase(file.make_group(fmt::format("phase_{}", k)), phases[k]);
  });
}

} // namespace strainwave
