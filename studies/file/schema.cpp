#include "strainwave/studies/file/schema.hpp"

#include "strainwave/model/gear_file/gear_schema.hpp"
#include "strainwave/studies/file/kind.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace strainwave {

namespace {

using Json = nlohmann::ordered_json;

Json object_of(StudyKeys keys, const void* blank);

Json shape_object(const StudyShape& shape) {
  return object_of(shape.keys(), shape.blank());
}

std::string keys_in_words(const StudyShape& shape) {
  std::string words;
  for (const StudyKey& key : shape.keys())
    words += fmt::format("{}{}", words.empty() ? "" : ", ", key.field.path);
  return words;
}

/// Nothing where the default is an empty text or list.
FieldValue default_of(const StudyKey& key, const void* blank) {
  FieldValue value = key.read(blank);
  if (const auto* words = std::get_if<std::string>(&value); words && words->empty())
    return {};
  if (const auto* list = std::get_if<std::vector<double>>(&value); list && list->empty())
    return {};
  return value;
}

Json key_schema(const StudyKey& key, const void* blank) {
  switch (key.holds) {
  case StudyKey::Holds::value:
    return field_schema(key.field, default_of(key, blank));
  case StudyKey::Holds::table:
    return shape_object(key.shapes.front());
  case StudyKey::Holds::names:
    return Json{{"type", "array"}, {"items", {{"type", "string"}}}};
  case StudyKey::Holds::one_of:
    break;
  }
  Json shapes = Json::array();
  for (const StudyShape& shape : key.shapes)
    shapes.push_back(Json{{"type", "object"},
                          {"properties", {{std::string(shape.name), shape_object(shape)}}},
                          {"required", {std::string(shape.name)}},
                          {"additionalProperties", false}});
  return Json{{"description", fmt::format("one {}", key.what)}, {"oneOf", shapes}};
}

Json object_of(StudyKeys keys, const void* blank) {
  Json properties = Json::object(), required = Json::array();
  for (const StudyKey& key : keys) {
    properties[std::string(key.field.path)] = key_schema(key, blank);
    if (key.field.required)
      required.push_back(key.field.path);
  }
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty())
    schema["required"] = required;
  return schema;
}

std::string allowed_text(const StudyKey& key) {
  switch (key.holds) {
  case StudyKey::Holds::value:
    return allowed_words(key.field);
  case StudyKey::Holds::names:
    return "list of texts";
  case StudyKey::Holds::table:
    return fmt::format("`{{ {} }}`", keys_in_words(key.shapes.front()));
  case StudyKey::Holds::one_of:
    break;
  }
  std::string words;
  for (const StudyShape& shape : key.shapes)
    words +=
        fmt::format("{}`{{ {} = {{ {} }} }}`", words.empty() ? "" : ", ", shape.name, keys_in_words(shape));
  return words;
}

std::string default_words(const StudyKey& key, const void* blank) {
  if (key.field.required || key.holds == StudyKey::Holds::one_of)
    return "**required**";
  if (key.holds != StudyKey::Holds::value)
    return "absent";
  return std::visit(
      [](const auto& held) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
          return "absent";
        else
          return fmt::format("`{}`", Json(held).dump());
      },
      default_of(key, blank));
}

std::string table_of(StudyKeys keys, const void* blank) {
  std::string page = "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n";
  for (const StudyKey& key : keys)
    page += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.field.path, key.field.unit, allowed_text(key),
                        default_words(key, blank), key.field.sentence);
  return page;
}

/// A heading of the page: kinds may have a table of the same name with keys of their own.
struct Heading {
  StudyTable table;
  std::vector<const StudyKind*> kinds;
};

std::string in_words(const std::vector<const StudyKind*>& kinds) {
  std::string words;
  for (const StudyKind* kind : kinds)
    words += fmt::format("{}{}", words.empty() ? "" : ", ", kind->name());
  return words;
}

/// Tables of one name together; those that a later kind adds stand before what follows them there.
std::vector<std::vector<Heading>> headings_of(StudyKinds kinds) {
  std::vector<std::vector<Heading>> all;
  const auto find = [&](std::string_view name) {
    return std::ranges::find_if(all, [&](const auto& h) { return h.front().table.name == name; });
  };
  const auto keys_of = [](const StudyTable& table) { return table.keys ? table.keys().data() : nullptr; };
  for (const StudyKind* kind : kinds) {
    const std::vector<StudyTable> tables = study_tables(*kind);
    for (auto table = tables.begin(); table != tables.end(); ++table) {
      auto known = find(table->name);
      for (auto next = table + 1; known == all.end() && next != tables.end(); ++next)
        if (const auto place = find(next->name); place != all.end()) {
          known = all.insert(place, {Heading{*table, {}}});
          break;
        }
      if (known == all.end())
        known = all.insert(known, {Heading{*table, {}}});
      auto heading =
          std::ranges::find_if(*known, [&](const Heading& h) { return keys_of(h.table) == keys_of(*table); });
      if (heading == known->end())
        heading = known->insert(known->end(), {*table, {}});
      heading->kinds.push_back(kind);
    }
  }
  return all;
}

/// What differs from kind to kind: "failure_share: 0.5 in optimize, pareto; 0.01 in sweep".
std::string failure_shares(StudyKinds kinds) {
  std::vector<std::pair<double, std::vector<const StudyKind*>>> shares;
  for (const StudyKind* kind : kinds) {
    auto known = std::ranges::find(shares, kind->failure_share(), [](const auto& s) { return s.first; });
    if (known == shares.end())
      known = shares.insert(shares.end(), {kind->failure_share(), {}});
    known->second.push_back(kind);
  }
  std::string words;
  for (const auto& [share, of] : shares)
    words += fmt::format("{}{} in {}", words.empty() ? "" : "; ", share, in_words(of));
  return words;
}

} // namespace

Json study_json_schema(StudyKinds kinds) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "strainwave study file"},
              {"description", "The JSON image of a study file (TOML)"}};
  const std::vector<std::string_view> names = kind_names(kinds);
  const std::vector<StudyKey> top = top_keys(names);
  const StudyFile blank;
  Json branches = Json::array();
  for (const StudyKind* kind : kinds) {
    Json one = object_of(top, &blank);
    one["title"] = kind->name();
    one["description"] = kind->sentence();
    one["properties"]["kind"] = Json{{"const", kind->name()}};
    for (const StudyTable& table : study_tables(*kind)) {
      Json below = table.keys ? object_of(table.keys(), table.blank()) : Json{{"type", "object"}};
      below["description"] = table.sentence;
      one["properties"][std::string(table.name)] =
          table.repeated ? Json{{"type", "array"}, {"items", below}} : below;
      if (!table.missing.empty())
        one["required"].push_back(table.name);
    }
    branches.push_back(one);
  }
  schema["oneOf"] = branches;
  return schema;
}

std::string study_reference_page(StudyKinds kinds) {
  std::string page =
      "# The study file\n\n"
      "Made from the program's tables of keys by `strainwave schema --study --reference`; do not edit it by "
      "hand.\n"
      "A study file is TOML. `strainwave check FILE` validates one and prints it with every default filled "
      "in,\n"
      "`strainwave schema --study` prints a JSON Schema for editors. What the kinds do stands in\n"
      "[studies.md](studies.md) and [optimisation.md](optimisation.md); `studies/gallery/` holds studies "
      "that run.\n"
      "Brackets show whether the end of a range belongs to it: [0, 1) is 0 ≤ x < 1.\n\n"
      "## Kinds of study\n\n| kind | what it does |\n|---|---|\n";
  for (const StudyKind* kind : kinds)
    page += fmt::format("| `{}` | {} |\n", kind->name(), kind->sentence());
  const std::vector<std::string_view> names = kind_names(kinds);
  const StudyFile blank;
  page += "\n## At the top of the file\n\n";
  page += table_of(top_keys(names), &blank);
  for (const auto& headings : headings_of(kinds)) {
    const StudyTable& first = headings.front().table;
    page +=
        fmt::format("\n## {}{}{}\n", first.repeated ? "[[" : "[", first.name, first.repeated ? "]]" : "]");
    for (const Heading& heading : headings) {
      page +=
          fmt::format("\nKinds: {}. What it says: {}.\n", in_words(heading.kinds), heading.table.sentence);
      if (first.name == "limits")
        page += fmt::format("Where a file does not say, failure_share is {}.\n", failure_shares(kinds));
      if (heading.table.keys)
        page.append("\n").append(table_of(heading.table.keys(), heading.table.blank()));
    }
  }
  return page;
}

} // namespace strainwave
