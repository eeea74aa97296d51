#include "strainwave/model/export/result_json.hpp"

#include "strainwave/model/export/load_path_export.hpp"
#include "strainwave/model/results/result_fields.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace strainwave {

using Json = nlohmann::ordered_json;

namespace {

Json json_of(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template <class T>
Json json_of(const std::vector<T>& values) {
  Json array = Json::array();
  for (const auto& value : values)
    array.push_back(json_of(value));
  return array;
}

Json json_of(const std::vector<int>& values) {
  return values;
}

class JsonWriter final : public ResultWriter {
public:
  explicit JsonWriter(Json& to) : to_(to) {}

  void put(const FieldText& field, const ResultValue& value) override {
    const std::string name(field.name);
    std::visit(
        [&](const auto& held) {
          using Held = std::remove_cvref_t<decltype(held)>;
          if constexpr (std::is_same_v<Held, Null>)
            to_[name] = nullptr;
          else if constexpr (std::is_same_v<Held, bool> || std::is_same_v<Held, int> ||
                             std::is_same_v<Held, std::string>)
            to_[name] = held;
          else if constexpr (!std::is_same_v<Held, Absent>)
            to_[name] = json_of(held);
        },
        value);
  }
  std::unique_ptr<ResultWriter> block(std::string_view name) override {
    Json& inside = to_[std::string(name)] = Json::object();
    return std::make_unique<JsonWriter>(inside);
  }
  std::unique_ptr<ResultWriter> element(std::string_view list, std::size_t) override {
    Json& all = to_[std::string(list)];
    all.push_back(Json::object());
    return std::make_unique<JsonWriter>(all.back());
  }
  void no_block(std::string_view name) override { to_[std::string(name)] = nullptr; }

private:
  Json& to_;
};

Json path_point_json(const PathPoint& point) {
  return {{"tooth", point.tooth},
          {"phi_deg", point.phi_deg},
          {"flank", point.coast ? "coast" : "drive"},
          {"height_mm", point.flank_radius_mm},
          {"z_mm", point.z_mm}};
}

Json path_json(const LoadPath& path) {
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

} // namespace

Json result_json(const ForwardResult& result, const LoadPath* path) {
  Json json;
  JsonWriter writer(json);
  write_result(result, writer);
  return json;
}

std::string result_json_text(const ForwardResult& result, const LoadPath* path) {
  return result_json(result, path).dump(2);
}

} // namespace strainwave
