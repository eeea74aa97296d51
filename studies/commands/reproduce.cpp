#include "strainwave/studies/commands/reproduce.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/optimize/gear/gear_evaluator.hpp"
#include "strainwave/studies/commands/kinds.hpp"
#include "strainwave/studies/file/study_gear.hpp"
#include "strainwave/studies/results/results_reader.hpp"
#include "strainwave/studies/search/optimisation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace strainwave {

namespace {

[[noreturn]] void refuse(std::uint64_t index, std::uint64_t rows) {
  throw std::out_of_range(fmt::format("--index must be from 0 to {}: the study has {} evaluations; got {}",
                                      rows - 1, rows, index));
}

std::vector<NamedValue> named(const std::vector<TableColumn>& columns, std::span<const double> values) {
  std::vector<NamedValue> all;
  for (std::size_t i = 0; i < columns.size(); ++i)
    all.push_back({columns[i].name, columns[i].unit, values[i]});
  return all;
}

std::optional<StoredResults> stored(const std::filesystem::path& folder) {
  const auto path = folder / "results.h5";
  if (!std::filesystem::exists(path))
    return std::nullopt;
  return read_results_table(path);
}

/// Nothing where the row has not been evaluated.
std::optional<bool> same_as(const StoredResults& known, const ReproducedRow& row) {
  if (row.row >= known.rows || known.status[row.row] == row_missing)
    return std::nullopt;
  if (known.status_name(row.row) != row.status)
    return false;
  if (row.status != "ok")
    return true;
  for (std::size_t i = 0; i < row.outputs.size(); ++i) {
    const double was = known.outputs[row.row * known.output_columns.size() + i];
    if (std::memcmp(&was, &row.outputs[i].value, sizeof was) != 0 &&
        !(std::isnan(was) && std::isnan(row.outputs[i].value)))
      return false;
  }
  return true;
}

Outcome<ReproducedRow> reproduce_sampled(const StudyFile& study, const RowKind& kind, std::uint64_t index,
                                         const RunContext& context) {
  const auto made = kind.make_rows(study, context);
  if (!made)
    return made.failure();
  const SampledStudy& rows = *made;
  if (index >= rows.rows)
    refuse(index, rows.rows);
  ReproducedRow row;
  row.row = index;
  row.rows = rows.rows;
  std::vector<double> named_inputs(rows.input_columns.size());
  if (!named_inputs.empty())
    rows.input_values(index, 1, named_inputs);
  row.inputs = named(rows.input_columns, named_inputs);
  std::vector<double> inputs(rows.model->inputs()), outputs(rows.model->outputs(), 0.0);
  std::vector<std::uint8_t> status(1, row_ok);
  std::vector<RowMessage> messages;
  if (!inputs.empty())
    rows.inputs(index, 1, inputs);
  RowSlice slice{index, 1, inputs, outputs, status, &messages, 0};
  rows.model->worker()->evaluate(slice);
  row.status = rows.model->status_name(status[0]);
  row.message = messages.empty() ? "" : messages.front().text;
  if (status[0] == row_ok)
    row.outputs = named(rows.output_columns, outputs);
  try {
    if (rows.gear_of_row)
      row.gear = rows.gear_of_row(index);
  } catch (const FieldError&) { // the row says so itself
  }
  if (rows.describe_row)
    row.details = rows.describe_row(index);
  return row;
}

Outcome<ReproducedRow> reproduce_search(const StudyFile& study, const std::optional<StoredResults>& known,
                                        std::uint64_t index, const RunContext& context,
                                        const std::filesystem::path& folder) {
  if (!known)
    throw std::out_of_range(
        fmt::format("{} is not there: a search has no numbered evaluations before it has ended or "
                    "was stopped; run it first",
                    (folder / "results.h5").string()));
  if (index >= known->rows)
    refuse(index, known->rows);
  const DesignSpace design = study_design(study);
  const std::span<const double> x = std::span(known->inputs).subspan(index * design.size(), design.size());
  GearEvaluator model(study.gear, design, study_loads(study),
                      {.disk_cache = context.disk_cache, .threads = context.threads}, context.warn);
  const Evaluation e = model.evaluate(x);
  ReproducedRow row;
  row.row = index;
  row.rows = known->rows;
  row.status = e.status;
  row.message = e.message;
  row.inputs = named(known->input_columns, x);
  if (e.ok)
    row.outputs = named(known->output_columns, e.values);
  try {
    StudyFile changed = study;
    changed.gear = design.apply(study.gear, x);
    row.gear = gear_with_loads(changed);
  } catch (const FieldError&) { // a linked number left its range: the row says so
  }
  return row;
}

} // namespace

Outcome<ReproducedRow> reproduce_row(const std::filesystem::path& folder, std::uint64_t index,
                                     const RunContext& context) {
  const StudyFile study = read_plan(folder, study_kinds());
  const auto known = stored(folder);
  const RowKind* kind = row_kind(study);
  auto row = kind ? reproduce_sampled(study, *kind, index, context)
                  : reproduce_search(study, known, index, context, folder);
  if (!row)
    return row;
  ReproducedRow found = std::move(row).value();
  if (known)
    found.same_bits = same_as(*known, found);
  return found;
}

} // namespace strainwave
