// write_study(): the resolved study as a file.

#include "strainwave/model/gear_file/toml_writer.hpp"
#include "strainwave/studies/file/keys.hpp"
#include "strainwave/studies/file/study.hpp"

#include <fmt/format.h>

namespace strainwave {

namespace {

/// Keys that say nothing about this source are left out: they would be refused when the file is read.
bool applies(const StudySource& source, std::string_view key) {
  if (key == "path")
    return source.kind == SourceKind::gear_key;
  if (key == "harmonic")
    return source.kind == SourceKind::cumulative_pitch;
  if (key == "member")
    return source.kind != SourceKind::centre_offset && source.kind != SourceKind::ovality &&
           source.kind != SourceKind::gear_key;
  return true;
}

template <class Table>
std::string keys_of(const Table& table) {
  std::string text;
  for (const auto& key : study_keys(table)) {
    if constexpr (std::is_same_v<Table, StudySource>)
      if (!applies(table, key.field.path))
        continue;
    const FieldValue value = key.read(table);
    const auto* words = std::get_if<std::string>(&value);
    const auto* list = std::get_if<std::vector<double>>(&value);
    const bool absent =
        std::holds_alternative<std::monostate>(value) || (words && words->empty()) || (list && list->empty());
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

std::string link_of(const std::optional<VariableLink>& link) {
  return link ? fmt::format("link = {{ path = {}, ratio = {} }}\n", toml_value(link->path),
                            toml_value(link->ratio))
              : "";
}

std::string outputs_of(const std::vector<std::string>& outputs) {
  std::string list;
  for (const std::string& name : outputs)
    list += (list.empty() ? "" : ", ") + toml_value(name);
  return toml_line(outputs.empty() ? "# outputs =" : fmt::format("outputs = [{}]", list),
                   "what is recorded; absent: everything that there is");
}

template <class Shape>
std::string shape_text(const Shape& shape) {
  std::string keys;
  for (const auto& key : study_keys(shape))
    keys += fmt::format("{}{} = {}", keys.empty() ? "" : ", ", key.field.path, toml_value(key.read(shape)));
  return keys;
}

std::string search_tables(const StudyFile& study) {
  std::string text;
  for (const StudyVariable& variable : study.variables)
    text += "\n[[variable]]\n" + keys_of(variable) + link_of(variable.link);
  text += "\n[objective]\n" + keys_of(study.objective);
  for (const StudyConstraint& constraint : study.constraints)
    text += "\n[[constraint]]\n" + keys_of(constraint);
  if (study.kind == StudyKind::pareto)
    text += "\n[pareto]\n" + keys_of(study.pareto);
  return text + "\n[method]\n" + keys_of(study.method);
}

std::string sweep_tables(const StudyFile& study) {
  std::string text;
  for (const SweepVariable& variable : study.sweep_variables)
    text += "\n[[variable]]\n" + keys_of(variable) + link_of(variable.link);
  return text + "\n[sweep]\n" + keys_of(study.sweep) + outputs_of(study.sweep.outputs);
}

std::string sampled_tables(const StudyFile& study) {
  std::string text;
  for (const StudySource& source : study.sources) {
    const std::string shape = std::visit([](const auto& s) { return shape_text(s); }, source.distribution);
    text += "\n[[source]]\n" + keys_of(source) +
            fmt::format("distribution = {{ {} = {{ {} }} }}\n",
                        distribution_names[source.distribution.index()], shape);
  }
  for (const StudyCorrelation& correlation : study.correlations)
    text += "\n[[correlation]]\n" + keys_of(correlation);
  if (study.kind == StudyKind::sensitivity)
    return text + "\n[sensitivity]\n" + keys_of(study.sensitivity) + outputs_of(study.sensitivity.outputs);
  text += "\n[sampling]\n" + keys_of(study.sampling) + outputs_of(study.sampling.outputs);
  if (study.sampling.stop) {
    std::string keys;
    for (const auto& key : study_keys(*study.sampling.stop))
      if (const FieldValue value = key.read(*study.sampling.stop);
          !std::holds_alternative<std::monostate>(value))
        keys += fmt::format("{}{} = {}", keys.empty() ? "" : ", ", key.field.path, toml_value(value));
    text += fmt::format("stop = {{ {} }}\n", keys);
  }
  for (const StudyExceedance& exceedance : study.exceedances)
    text += "\n[[exceedance]]\n" + keys_of(exceedance);
  return text;
}

} // namespace

std::string write_study(const StudyFile& study) {
  std::string text = keys_of(study);
  text += changes_of("override", study.overrides);
  for (const LoadCase& load : study.load_cases)
    text += "\n[[load_case]]\n" + keys_of(load);
  if (study.kind == StudyKind::optimize || study.kind == StudyKind::pareto)
    text += search_tables(study);
  else if (study.kind == StudyKind::sweep)
    text += sweep_tables(study);
  else
    text += sampled_tables(study);
  text += "\n[limits]\n" + keys_of(study.limits);
  text += changes_of("reduced", study.reduced_changes);
  return text;
}

} // namespace strainwave
