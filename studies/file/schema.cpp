#include "strainwave/studies/file/schema.hpp"

#include "strainwave/model/gear_file/gear_schema.hpp"
#include "strainwave/studies/file/keys.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace strainwave {

namespace {

using Json = nlohmann::ordered_json;

/// What the visitors below are shown: one key, its default, or a key that is a table of its own.
struct KeyRow {
  std::string name;
  const Field* field = nullptr; ///< null: a compound key
  FieldValue default_value;
  Json compound;        ///< its schema
  std::string allowed;  ///< of a compound key
  std::string sentence; ///< of a compound key
};

template <class Table>
Json object_of();

template <class Shape>
void add_shape(Json& shapes, std::size_t i) {
  const std::string name(distribution_names[i]);
  shapes.push_back(Json{{"type", "object"},
                        {"properties", {{name, object_of<Shape>()}}},
                        {"required", {name}},
                        {"additionalProperties", false}});
}

Json distribution_schema() {
  Json shapes = Json::array();
  add_shape<Normal>(shapes, 0);
  add_shape<TruncatedNormal>(shapes, 1);
  add_shape<Uniform>(shapes, 2);
  add_shape<Triangular>(shapes, 3);
  add_shape<Lognormal>(shapes, 4);
  add_shape<Tabulated>(shapes, 5);
  return Json{{"description", "one distribution"}, {"oneOf", shapes}};
}

template <class Table>
std::string keys_in_words() {
  std::string words;
  for (const auto& key : study_keys(Table{}))
    words += fmt::format("{}{}", words.empty() ? "" : ", ", key.field.path);
  return words;
}

std::string distributions_in_words() {
  return fmt::format(
      "`{{ normal = {{ {} }} }}`, `{{ truncated_normal = {{ {} }} }}`, `{{ uniform = {{ {} }} }}`, "
      "`{{ triangular = {{ {} }} }}`, `{{ lognormal = {{ {} }} }}`, `{{ table = {{ {} }} }}`",
      keys_in_words<Normal>(), keys_in_words<TruncatedNormal>(), keys_in_words<Uniform>(),
      keys_in_words<Triangular>(), keys_in_words<Lognormal>(), keys_in_words<Tabulated>());
}

KeyRow compound_row(std::string_view name) {
  KeyRow row;
  row.name = name;
  if (name == "link") {
    row.compound = object_of<VariableLink>();
    row.allowed = fmt::format("`{{ {} }}`", keys_in_words<VariableLink>());
    row.sentence = "another number of the gear that moves along: ratio times this one";
  } else if (name == "distribution") {
    row.compound = distribution_schema();
    row.allowed = distributions_in_words();
    row.sentence = "of each of its numbers: µm, or the unit of the gear's key";
  } else if (name == "stop") {
    row.compound = object_of<StudyStop>();
    row.allowed = fmt::format("`{{ {} }}`", keys_in_words<StudyStop>());
    row.sentence = "end by itself: design \"random\" only, no shards";
  } else {
    row.compound = Json{{"type", "array"}, {"items", {{"type", "string"}}}};
    row.allowed = "list of texts";
    row.sentence = "which outputs are recorded; absent: all that there are";
  }
  return row;
}

template <class Table>
std::vector<KeyRow> rows_of() {
  std::vector<KeyRow> rows;
  for (const auto& key : study_keys(Table{})) {
    KeyRow row;
    row.name = key.field.path;
    row.field = &key.field;
    row.default_value = key.read(Table{});
    if (const auto* words = std::get_if<std::string>(&row.default_value); words && words->empty())
      row.default_value = {};
    if (const auto* list = std::get_if<std::vector<double>>(&row.default_value); list && list->empty())
      row.default_value = {};
    rows.push_back(std::move(row));
  }
  for (const std::string_view name : compound_keys<Table>())
    rows.push_back(compound_row(name));
  return rows;
}

Json object_of(const std::vector<KeyRow>& rows) {
  Json properties = Json::object(), required = Json::array();
  for (const KeyRow& row : rows) {
    properties[row.name] = row.field ? field_schema(*row.field, row.default_value) : row.compound;
    if (row.field && row.field->required)
      required.push_back(row.name);
  }
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty())
    schema["required"] = required;
  return schema;
}

template <class Table>
Json object_of() {
  return object_of(rows_of<Table>());
}

/// Keys below a heading; nothing where any path may stand (override, reduced).
std::vector<KeyRow> rows_below(std::string_view heading, StudyKind kind) {
  if (heading == "load_case")
    return rows_of<LoadCase>();
  if (heading == "variable")
    return kind == StudyKind::sweep ? rows_of<SweepVariable>() : rows_of<StudyVariable>();
  if (heading == "objective")
    return rows_of<StudyObjective>();
  if (heading == "constraint")
    return rows_of<StudyConstraint>();
  if (heading == "pareto")
    return rows_of<StudyPareto>();
  if (heading == "method")
    return rows_of<StudyMethod>();
  if (heading == "sweep")
    return rows_of<StudySweep>();
  if (heading == "source")
    return rows_of<StudySource>();
  if (heading == "correlation")
    return rows_of<StudyCorrelation>();
  if (heading == "sampling")
    return rows_of<StudySampling>();
  if (heading == "exceedance")
    return rows_of<StudyExceedance>();
  if (heading == "sensitivity")
    return rows_of<StudySensitivity>();
  if (heading == "limits")
    return rows_of<StudyLimits>();
  return {};
}

std::string default_words(const KeyRow& row) {
  if (row.field && row.field->required)
    return "**required**";
  if (row.name == "distribution")
    return "**required**";
  if (row.name == "failure_share")
    return "0.01; searches: 0.5";
  return std::visit(
      [](const auto& held) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
          return "absent";
        else
          return fmt::format("`{}`", Json(held).dump());
      },
      row.default_value);
}

std::string table_of(const std::vector<KeyRow>& rows) {
  std::string page = "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n";
  for (const KeyRow& row : rows)
    page += row.field ? fmt::format("| `{}` | {} | {} | {} | {} |\n", row.name, row.field->unit,
                                    allowed_words(*row.field), default_words(row), row.field->sentence)
                      : fmt::format("| `{}` |  | {} | {} | {} |\n", row.name, row.allowed, default_words(row),
                                    row.sentence);
  return page;
}

std::string kinds_of(const StudyHeading& heading) {
  std::string words;
  for (std::size_t k = 0; k < study_kinds.size(); ++k)
    if (heading.belongs_to(static_cast<StudyKind>(k)))
      words += fmt::format("{}{}", words.empty() ? "" : ", ", study_kinds[k]);
  return words;
}

} // namespace

Json study_json_schema() {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "strainwave study file"},
              {"description", "The JSON image of a study file (TOML)"}};
  Json kinds = Json::array();
  for (std::size_t k = 0; k < study_kinds.size(); ++k) {
    const auto kind = static_cast<StudyKind>(k);
    Json one = object_of<StudyFile>();
    one["title"] = study_kinds[k];
    one["properties"]["kind"] = Json{{"const", study_kinds[k]}};
    for (const StudyHeading& heading : study_headings()) {
      if (!heading.belongs_to(kind))
        continue;
      const auto rows = rows_below(heading.name, kind);
      Json below = rows.empty() ? Json{{"type", "object"}} : object_of(rows);
      below["description"] = heading.sentence;
      one["properties"][std::string(heading.name)] =
          heading.repeated ? Json{{"type", "array"}, {"items", below}} : below;
      if (heading.needed(kind))
        one["required"].push_back(heading.name);
    }
    kinds.push_back(one);
  }
  schema["oneOf"] = kinds;
  return schema;
}

std::string study_reference_page() {
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
      "## At the top of the file\n\n";
  page += table_of(rows_of<StudyFile>());
  for (const StudyHeading& heading : study_headings()) {
    page += fmt::format("\n## {}{}{}\n\nKinds: {}. What it says: {}.\n", heading.repeated ? "[[" : "[",
                        heading.name, heading.repeated ? "]]" : "]", kinds_of(heading), heading.sentence);
    if (heading.name == "variable") {
      page += "\nIn searches (optimize, pareto):\n\n";
      page += table_of(rows_of<StudyVariable>());
      page +=
          "\nIn sweeps; `values`, or `lower`, `upper` and `count`:\n\n" + table_of(rows_of<SweepVariable>());
      continue;
    }
    if (const auto rows = rows_below(heading.name, StudyKind::optimize); !rows.empty()) {
      page += "\n";
      page += table_of(rows);
    }
  }
  return page;
}

} // namespace strainwave
