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

} // namespace

Json result_json(const ForwardResult& result, const LoadPath* path) {
  Json json;
  JsonWriter writer(json);
  write_result(result, writer);
  if (path)
    json["path"] = load_path_json(*path);
  return json;
}

std::string result_json_text(const ForwardResult& result, const LoadPath* path) {
  return result_json(result, path).dump(2);
}

} // namespace strainwave
