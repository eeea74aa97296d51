#include "strainwave/model/export/load_path_export.hpp"

#include <nlohmann/json.hpp>

#include <limits>

namespace strainwave {

using Json = nlohmann::ordered_json;

namespace {

Json path_point_json(const PathPoint& point) {
  return {{"tooth", point.tooth},
          {"phi_deg", point.phi_deg},
          {"flank", point.coast ? "coast" : "drive"},
          {"height_mm", point.flank_radius_mm},
          {"z_mm", point.z_mm}};
}

template <class T>
void put(const hdf5::Group& group, const char* name, const char* unit, const std::vector<T>& values) {
  group.put(name, values).set_text("units", unit);
}
void put(const hdf5::Group& group, const char* name, const char* unit, double value) {
  group.put_number(name, value).set_text("units", unit);
}

} // namespace

Json load_path_json(const LoadPath& path) {
  Json json = {{"phase", path.phase}};
  json["start"] = {{"rotation_rad", path.start_rotation_rad},
                   {"torque_nm", path.start_torque_nm},
                   {"stiffness_nm_per_rad", path.start_stiffness_nm_per_rad},
                   {"carries", Json::array()}};
  for (const PathPoint& point : path.carries_at_start)
    json["start"]["carries"].push_back(path_point_json(point));
  json["events"] = Json::array();
  for (const LoadPathEvent& event : path.events) {
    Json changes = Json::array();
    for (const LoadPathChange& change : event.changes) {
      Json one = path_point_json(change.point);
      one["change"] = change.joins ? "joins" : "leaves";
      one["whole_tooth"] = change.whole_tooth;
      changes.push_back(std::move(one));
    }
    json["events"].push_back({{"rotation_rad", event.rotation_rad},
                              {"torque_nm", event.torque_nm},
                              {"stiffness_nm_per_rad", event.stiffness_nm_per_rad},
                              {"changes", std::move(changes)},
                              {"wall_joins", event.wall_joins},
                              {"wall_leaves", event.wall_leaves}});
  }
  json["end"] = {{"rotation_rad", path.end_rotation_rad}, {"torque_nm", path.end_torque_nm}};
  json["loads"] = Json::array();
  for (const LoadOnPath& load : path.loads) {
    Json one = {{"torque_nm", load.torque_nm},
                {"rotation_rad", load.rotation_rad},
                {"direct_difference", load.direct_difference}};
    if (load.exact_minus_path_rad)
      one["exact_minus_path_rad"] = *load.exact_minus_path_rad;
    if (load.exact_minus_path_nm)
      one["exact_minus_path_nm"] = *load.exact_minus_path_nm;
    json["loads"].push_back(std::move(one));
  }
  return json;
}

void put_load_path(const LoadPath& path, const hdf5::Group& parent) {
  const hdf5::Group group = parent.make_group("path");
  put(group, "phase", "1", path.phase);
  put(group, "start_rotation", "rad", path.start_rotation_rad);
  put(group, "start_torque", "N.m", path.start_torque_nm);
  put(group, "start_stiffness", "N.m/rad", path.start_stiffness_nm_per_rad);
  put(group, "end_rotation", "rad", path.end_rotation_rad);
  put(group, "end_torque", "N.m", path.end_torque_nm);
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
  const hdf5::Group events = group.make_group("events");
  put(events, "rotation", "rad", rotation);
  put(events, "torque", "N.m", torque);
  put(events, "stiffness", "N.m/rad", stiffness);
  put(events, "wall_joins", "1", wall_joins);
  put(events, "wall_leaves", "1", wall_leaves);
  const hdf5::Group changes = group.make_group("changes");
  put(changes, "event", "1", event_of);
  put(changes, "tooth", "1", tooth);
  put(changes, "phi", "deg", phi);
  put(changes, "coast", "1", coast);
  put(changes, "height", "mm", height);
  put(changes, "z", "mm", z);
  put(changes, "joins", "1", joins);
  put(changes, "whole_tooth", "1", whole_tooth);
  std::vector<double> at_torque, at_rotation, direct, exact_rad, exact_nm;
  for (const LoadOnPath& load : path.loads) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    at_torque.push_back(load.torque_nm);
    at_rotation.push_back(load.rotation_rad);
    direct.push_back(load.direct_difference);
    exact_rad.push_back(load.exact_minus_path_rad.value_or(none));
    exact_nm.push_back(load.exact_minus_path_nm.value_or(none));
  }
  const hdf5::Group loads = group.make_group("loads");
  put(loads, "torque", "N.m", at_torque);
  put(loads, "rotation", "rad", at_rotation);
  put(loads, "direct_difference", "1", direct);
  put(loads, "exact_minus_path_rotation", "rad", exact_rad);
  put(loads, "exact_minus_path_torque", "N.m", exact_nm);
}

} // namespace strainwave
