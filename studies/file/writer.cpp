// write_study(): the resolved study as a file.

#include "strainwave/model/gear_file/toml_writer.hpp"
#include "strainwave/studies/file/kind.hpp"

#include <fmt/format.h>

namespace strainwave {

namespace {

/// The keys of an inner table that have a value: "path = …, ratio = …".
std::string inner_text(const StudyShape& shape, const void* inner) {
  std::string text;
  for (const StudyKey& key : shape.keys())
    if (const FieldValue value = key.read(inner); !std::holds_alternative<std::monostate>(value))
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key.field.path, toml_value(value));
  return text;
}

std::string value_line(const StudyKey& key, const void* table) {
  const FieldValue value = key.read(table);
  const auto* words = std::get_if<std::string>(&value);
  const auto* list = std::get_if<std::vector<double>>(&value);
  const bool absent =
      std::holds_alternative<std::monostate>(value) || (words && words->empty()) || (list && list->empty());
  std::string comment(key.field.unit);
  comment.append(comment.empty() ? "" : "; ").append(key.field.sentence);
  return toml_line(absent ? fmt::format("# {} =", key.field.path)
                          : fmt::format("{} = {}", key.field.path, toml_value(value)),
                   comment);
}

std::string names_line(const StudyKey& key, const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ", ") + toml_value(name);
  return toml_line(names.empty() ? fmt::format("# {} =", key.field.path)
                                 : fmt::format("{} = [{}]", key.field.path, list),
                   key.field.sentence);
}

std::string keys_text(StudyKeys keys, const void* table) {
  std::string text;
  for (const StudyKey& key : keys) {
    if (key.applies && !key.applies(table))
      continue;
    switch (key.holds) {
    case StudyKey::Holds::value:
      text += value_line(key, table);
      break;
    case StudyKey::Holds::names:
      text += names_line(key, key.list(table));
      break;
    case StudyKey::Holds::table:
      if (const void* inner = key.shapes.front().get(table))
        text += fmt::format("{} = {{ {} }}\n", key.field.path, inner_text(key.shapes.front(), inner));
      break;
    case StudyKey::Holds::one_of:
      for (const StudyShape& shape : key.shapes)
        if (const void* inner = shape.get(table))
          text +=
              fmt::format("{} = {{ {} = {{ {} }} }}\n", key.field.path, shape.name, inner_text(shape, inner));
      break;
    }
  }
  return text;
}

std::string changes_text(std::string_view heading, const std::vector<StudyChange>& changes) {
  if (changes.empty())
    return "";
  std::string text = fmt::format("\n[{}]\n", heading);
  for (const StudyChange& change : changes)
    text += fmt::format("{} = {}\n", toml_value(change.path), toml_value(change.value));
  return text;
}

} // namespace

std::string write_study(const StudyFile& study) {
  std::string text = keys_text(top_keys({}), &study);
  for (const StudyTable& table : study_tables(*study.kind)) {
    if (!table.keys)
      text += changes_text(table.name, table.name == "override" ? study.overrides : study.reduced_changes);
    else
      for (std::size_t i = 0; i < table.count(study); ++i)
        text += fmt::format(fmt::runtime(table.repeated ? "\n[[{}]]\n" : "\n[{}]\n"), table.name) +
                keys_text(table.keys(), table.read(study, i));
  }
  return text;
}

} // namespace strainwave
