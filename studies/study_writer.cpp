// write_study(): the resolved study as a file.

#include "model/gear_file/toml_writer.hpp"
#include "studies/study_file.hpp"
#include "studies/study_keys.hpp"

#include <fmt/format.h>

namespace strainwave {

namespace {

template <class Table>
std::string keys_of(const Table& table) {
  std::string text;
  for (const auto& key : study_keys(table)) {
    const FieldValue value = key.read(table);
    const auto* words = std::get_if<std::string>(&value);
    const bool absent = std::holds_alternative<std::monostate>(value) || (words && words->empty());
    std::string comment(key.field.unit);
    comment.append(comment.empty() ? "" : "; ").append(key.field.sentence);
    text += toml_line(absent ? fmt::format("# {} =", key.field.path)
                             : fmt::format("{} = {}", key.field.path, toml_value(value)),
                      comment);
  }
  return text;
}

std::string changes_of(const char* heading, const std::vector<StudyChange>& changes) {
  if (changes.empty())
    return "";
  std::string text = fmt::format("\n[{}]\n", heading);
  for (const StudyChange& change : changes)
    text += fmt::format("{} = {}\n", toml_value(change.path), toml_value(change.value));
  return text;
}

} // namespace

std::string write_study(const StudyFile& study) {
  std::string text = keys_of(study);
  text += changes_of("override", study.overrides);
  for (const LoadCase& load : study.load_cases)
    text += "\n[[load_case]]\n" + keys_of(load);
  for (const StudyVariable& variable : study.variables) {
    text += "\n[[variable]]\n" + keys_of(variable);
    if (variable.link)
      text += fmt::format("link = {{ path = {}, ratio = {} }}\n", toml_value(variable.link->path),
                          toml_value(variable.link->ratio));
  }
  text += "\n[objective]\n" + keys_of(study.objective);
  for (const StudyConstraint& constraint : study.constraints)
    text += "\n[[constraint]]\n" + keys_of(constraint);
  if (study.kind == StudyKind::pareto)
    text += "\n[pareto]\n" + keys_of(study.pareto);
  text += "\n[method]\n" + keys_of(study.method);
  text += "\n[limits]\n" + keys_of(study.limits);
  text += changes_of("reduced", study.reduced_changes);
  return text;
}

} // namespace strainwave
