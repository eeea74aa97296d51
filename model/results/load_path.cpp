#include "strainwave/model/results/load_path.hpp"

#include <algorithm>

namespace strainwave {

namespace {

struct PathLine {
  double rotation_rad, torque_nm, stiffness_nm_per_rad;
};

/// The line in front of the first event that lies behind the place.
template <class Behind>
PathLine line_of(const LoadPath& path, const Behind& behind) {
  const auto next = std::find_if(path.events.begin(), path.events.end(), behind);
  if (next == path.events.begin())
    return {path.start_rotation_rad, path.start_torque_nm, path.start_stiffness_nm_per_rad};
  const LoadPathEvent& event = *(next - 1);
  return {event.rotation_rad, event.torque_nm, event.stiffness_nm_per_rad};
}

} // namespace

double rotation_at(const LoadPath& path, double torque_nm) {
  const PathLine line =
      line_of(path, [&](const LoadPathEvent& event) { return event.torque_nm > torque_nm; });
  return line.stiffness_nm_per_rad > 0.0
             ? line.rotation_rad + (torque_nm - line.torque_nm) / line.stiffness_nm_per_rad
             : line.rotation_rad;
}

double torque_at(const LoadPath& path, double rotation_rad) {
  const PathLine line =
      line_of(path, [&](const LoadPathEvent& event) { return event.rotation_rad > rotation_rad; });
  return line.torque_nm + line.stiffness_nm_per_rad * (rotation_rad - line.rotation_rad);
}

} // namespace strainwave
