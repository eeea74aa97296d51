// Keys and tables that all kinds of study share.

#include "strainwave/studies/file/key_rows.hpp"

#include <array>

namespace strainwave {

using namespace study_rows;

/// Found beside Direction by choice_row().
static std::span<const std::string_view> names_of(Direction direction) {
  return choice_names(direction);
}

std::vector<StudyKey> top_keys(std::span<const std::string_view> kinds) {
  StudyKey kind;
  kind.field.path = "kind";
  kind.field.kind = FieldKind::choice;
  kind.field.choices = kinds;
  kind.field.sentence = "what kind of study this is";
  kind.field.required = true;
  kind.read = [](const void* from) -> FieldValue {
    const StudyKind* known = static_cast<const StudyFile*>(from)->kind;
    return known ? FieldValue(std::string(known->name())) : FieldValue();
  };
  kind.write = [](void*, const FieldValue&) {}; // it is read before all others
  return {kind, row<&StudyFile::gear_file>("gear", "", any, "the gear file, relative to this file", needed),
          row<&StudyFile::seed>("seed", "", from_zero(2147483647.0), "seed of everything random")};
}

StudyKeys study_keys(const LoadCase&) {
  static const std::array keys{
      row<&LoadCase::torque_nm>("torque_nm", "N·m", from_zero(1e6), "torque on the circular spline"),
      row<&LoadCase::rotation_rad>("rotation_rad", "rad", from_zero(1.0),
                                   "rotation of the circular spline, instead"),
      row<&LoadCase::phases>("phases", "", within(1, 1000), "meshing positions over one pitch"),
      choice_row<&LoadCase::direction>("direction", "which flanks carry the load"),
  };
  return keys;
}

StudyKeys study_keys(const VariableLink&) {
  static const std::array keys{
      row<&VariableLink::path>("path", "", any, "the number of the gear that moves along", needed),
      row<&VariableLink::ratio>("ratio", "", any, "that number over the variable", needed),
  };
  return keys;
}

StudyKeys study_keys(const StudyLimits&) {
  static const std::array keys{
      row<&StudyLimits::failure_share>("failure_share", "", within(0.0, 1.0),
                                       "share of evaluations that may fail; more: exit code 3"),
  };
  return keys;
}

std::vector<StudyTable> study_tables(const StudyKind& kind) {
  std::vector<StudyTable> tables{
      {.name = "override", .sentence = "changes of the gear: any of its keys by its path"},
      table<&StudyFile::load_cases>("load_case", "a load; without any, those of the gear's [load]")};
  const auto own = kind.tables();
  tables.insert(tables.end(), own.begin(), own.end());
  tables.push_back(table<&StudyFile::limits>("limits", "when the study counts as failed"));
  tables.push_back(
      {.name = "reduced",
       .sentence = "what --reduced changes: keys of this file (\"load_case[0].phases\") or of the gear"});
  return tables;
}

std::vector<std::string_view> kind_names(StudyKinds kinds) {
  std::vector<std::string_view> names;
  for (const StudyKind* kind : kinds)
    names.push_back(kind->name());
  return names;
}

} // namespace strainwave
