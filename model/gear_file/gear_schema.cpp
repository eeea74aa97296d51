#include "strainwave/model/gear_file/gear_schema.hpp"

#include "strainwave/model/gear/fields.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace strainwave {

namespace {

using Json = nlohmann::ordered_json;

void add_range(Json& schema, const Field& field) {
  const auto as_written = [&field](double bound) {
    return field.kind == FieldKind::integer ? Json(static_cast<int>(bound)) : Json(bound);
  };
  if (std::isfinite(field.range.lower))
    schema[field.range.lower_open ? "exclusiveMinimum" : "minimum"] = as_written(field.range.lower);
  if (std::isfinite(field.range.upper))
    schema[field.range.upper_open ? "exclusiveMaximum" : "maximum"] = as_written(field.range.upper);
}

Json as_json(const FieldValue& value) {
  return std::visit(
      [](const auto& held) {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
          return Json();
        else
          return Json(held);
      },
      value);
}

Json default_json(const Field& field) {
  return as_json(field.read(Gear{}));
}

} // namespace

Json field_schema(const Field& field, const FieldValue& default_value) {
  Json schema;
  std::string description(field.sentence);
  if (!field.unit.empty())
    description.append(" [").append(field.unit).append("]");
  schema["description"] = description;
  switch (field.kind) {
  case FieldKind::number:
    schema["type"] = "number";
    break;
  case FieldKind::integer:
    schema["type"] = "integer";
    break;
  case FieldKind::text:
    schema["type"] = "string";
    break;
  case FieldKind::choice:
    schema["type"] = "string";
    schema["enum"] = std::vector<std::string>(field.choices.begin(), field.choices.end());
    break;
  case FieldKind::number_list:
    schema["type"] = "array";
    break;
  }
  if (field.kind == FieldKind::number_list) {
    Json item{{"type", "number"}};
    add_range(item, field);
    schema["items"] = item;
    if (field.list_length > 0)
      schema["oneOf"] = Json::array(
          {Json{{"maxItems", 0}}, Json{{"minItems", field.list_length}, {"maxItems", field.list_length}}});
  } else {
    add_range(schema, field);
  }
  if (!field.required && !std::holds_alternative<std::monostate>(default_value))
    schema["default"] = as_json(default_value);
  return schema;
}

namespace {

Json field_schema(const Field& field) {
  return strainwave::field_schema(field, field.may_be_absent ? FieldValue() : field.read(Gear{}));
}

/// The object of one table with its keys and the tables inside it.
Json table_schema(std::string_view table, std::string_view sentence) {
  Json schema{{"type", "object"}, {"description", sentence}};
  Json properties = Json::object();
  Json required = Json::array();
  for (const Field& field : gear_fields()) {
    if (field.table() != table)
      continue;
    properties[std::string(field.key())] = field_schema(field);
    if (field.required)
      required.push_back(field.key());
  }
  for (const FieldTable& inner : gear_tables()) {
    const std::size_t dot = inner.path.rfind('.');
    const std::string_view parent =
        dot == std::string_view::npos ? std::string_view() : inner.path.substr(0, dot);
    if (parent != table)
      continue;
    const std::string key(inner.path.substr(parent.empty() ? 0 : parent.size() + 1));
    properties[key] = table_schema(inner.path, inner.sentence);
    if (properties[key].contains("required"))
      required.push_back(key);
  }
  schema["properties"] = properties;
  if (!required.empty())
    schema["required"] = required;
  schema["additionalProperties"] = false;
  return schema;
}

std::string default_words(const Field& field) {
  if (field.required)
    return "**required**";
  const Json value = default_json(field);
  if (value.is_null())
    return "absent";
  return value == "" ? std::string("empty") : fmt::format("`{}`", value.dump());
}

} // namespace

std::string allowed_words(const Field& field) {
  if (!field.choices.empty()) {
    std::string words;
    for (const std::string_view choice : field.choices)
      words += fmt::format("{}`{}`", words.empty() ? "" : ", ", choice);
    return words;
  }
  std::string words = field.kind == FieldKind::number_list ? "list of numbers"
                      : field.kind == FieldKind::text      ? "text"
                      : field.kind == FieldKind::integer   ? "whole number"
                                                           : "number";
  if (field.list_length > 0)
    words = fmt::format("list of {} rising numbers, or empty", field.list_length);
  const Range& range = field.range;
  if (std::isfinite(range.lower) && std::isfinite(range.upper))
    words += fmt::format(", {}{}, {}{}", range.lower_open ? "(" : "[", shortest(range.lower),
                         shortest(range.upper), range.upper_open ? ")" : "]");
  return words;
}

nlohmann::ordered_json json_schema() {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "strainwave gear file"}};
  schema.update(table_schema(
      "", "Everything that can be said about a strain wave gear, as the JSON image of its TOML file"));
  return schema;
}

std::string reference_page() {
  std::string page =
      "# The gear file\n\n"
      "Made from the program's table of fields by `strainwave schema --reference`; do not edit it by hand.\n"
      "A gear file is TOML. `strainwave example` prints a complete one, `strainwave check FILE` validates a\n"
      "file and prints it with every default filled in, `strainwave schema` prints a JSON Schema for "
      "editors.\n"
      "Brackets show whether the end of a range belongs to it: [0, 1) is 0 ≤ x < 1.\n"
      "`load.torque_nm` and `load.rotation_rad` may be given together: the torques are solved first.\n";
  std::string_view open_table = "none yet";
  for (const Field& field : gear_fields()) {
    if (field.table() != open_table) {
      open_table = field.table();
      page += open_table.empty()
                  ? "\n## At the top of the file\n\n"
                  : fmt::format("\n## [{}]\n\n{}.\n\n", open_table, find_table(open_table)->sentence);
      page += "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n";
    }
    page += fmt::format("| `{}` | {} | {} | {} | {} |\n", field.key(), field.unit, allowed_words(field),
                        default_words(field), field.sentence);
  }
  return page;
}

} // namespace strainwave
