#include "strainwave/studies/tables/statistics.hpp"

#include "strainwave/common/statistics/association.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace strainwave {

namespace {

std::optional<OutputRange> range_of(const RowTable& table, std::uint32_t output) {
  std::optional<OutputRange> range;
  for (std::uint64_t row = 0; row < table.rows(); ++row) {
    if (table.status()[row] != row_ok)
      continue;
    const double value = table.value(row, output);
    if (!range)
      range = OutputRange{value, value, row, row};
    if (value < range->least)
      range->least = value, range->least_row = row;
    if (value > range->greatest)
      range->greatest = value, range->greatest_row = row;
  }
  return range;
}

/// All rows of one output, failed ones with whatever stands there.
std::vector<double> whole_column(const RowTable& table, std::uint32_t output) {
  std::vector<double> column(table.rows());
  for (std::uint64_t row = 0; row < table.rows(); ++row)
    column[row] = table.value(row, output);
  return column;
}

class MonteCarloStatistics {
public:
  MonteCarloStatistics(const StudyFile& study, const SampledStudy& rows, const RowTable& table)
      : study_(study), rows_(rows), table_(table) {
    read_inputs();
  }

  void add(OutputStatistics& s, std::uint32_t output) const {
    SummaryRequest request;
    request.quantiles = study_.sampling.quantiles;
    for (const StudyExceedance& e : study_.exceedances)
      if (e.output == s.output)
        request.limits.push_back(e.limit);
    const std::vector<double> values = table_.column(output);
    try {
      s.summary = study_.sampling.design == SamplingDesign::random ? summarise(values, request)
                                                                   : randomised(output, request);
    } catch (const std::invalid_argument&) {
      s.missing = fmt::format("{} rows with a result are too few for statistics", values.size());
      return;
    }
    const std::vector<double> ranks = ranks_of(values);
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      s.correlations.push_back({rows_.input_columns[i].name, pearson_correlation(inputs_[i], values),
                                spearman_of_ranks(ranks_[i], ranks)});
  }

private:
  /// Named inputs of the rows with a result, column by column.
  void read_inputs() {
    const std::size_t columns = rows_.input_columns.size();
    inputs_.resize(columns);
    std::vector<double> chunk;
    for (std::uint64_t first = 0; columns > 0 && first < table_.rows();) {
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(4096, table_.rows() - first));
      chunk.resize(count * columns);
      rows_.input_values(first, count, chunk);
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < columns; ++i)
          if (table_.status()[first + k] == row_ok)
            inputs_[i].push_back(chunk[k * columns + i]);
      first += count;
    }
    for (const auto& column : inputs_)
      ranks_.push_back(ranks_of(column));
  }

  Summary randomised(std::uint32_t output, const SummaryRequest& request) const {
    const auto parts = static_cast<std::uint64_t>(study_.sampling.randomisations);
    const std::uint64_t each = table_.rows() / parts;
    std::vector<std::vector<double>> values(parts);
    for (std::uint64_t row = 0; row < each * parts; ++row)
      if (table_.status()[row] == row_ok)
        values[row / each].push_back(table_.value(row, output));
    const std::vector<std::span<const double>> spans(values.begin(), values.end());
    return summarise_randomised(spans, request);
  }

  const StudyFile& study_;
  const SampledStudy& rows_;
  const RowTable& table_;
  std::vector<std::vector<double>> inputs_, ranks_;
};

void add_indices(const StudyFile& study, const SampledStudy& rows, const RowTable& table, OutputStatistics& s,
                 std::uint32_t output) {
  try {
    if (study.sensitivity.method == SensitivityMethod::sobol)
      s.sobol = nested_sobol_indices(
          whole_column(table, output), table.status(), rows.index_names.size(),
          std::min<std::uint64_t>(64, static_cast<std::uint64_t>(study.sensitivity.samples)),
          {.seed = static_cast<std::uint64_t>(study.seed)});
    else if (study.sensitivity.method == SensitivityMethod::morris && rows.morris)
      s.morris = morris_effects(*rows.morris, whole_column(table, output), table.status());
  } catch (const std::invalid_argument&) {
    s.missing = "too few whole blocks of rows with a result for indices";
  }
}

} // namespace

SampledStatistics statistics_of(const StudyFile& study, const SampledStudy& rows, const RowTable& table) {
  SampledStatistics all;
  all.index_names = rows.index_names;
  std::optional<MonteCarloStatistics> monte_carlo;
  if (study.kind == StudyKind::monte_carlo)
    monte_carlo.emplace(study, rows, table);
  for (std::uint32_t output = 0; output < table.outputs(); ++output) {
    OutputStatistics s;
    s.output = rows.output_columns[output].name;
    s.unit = rows.output_columns[output].unit;
    s.range = range_of(table, output);
    if (!s.range)
      s.missing = "no row has a result";
    else if (monte_carlo)
      monte_carlo->add(s, output);
    else if (study.kind == StudyKind::sensitivity)
      add_indices(study, rows, table, s, output);
    all.outputs.push_back(std::move(s));
  }
  if (rows.elasticities && table.failed() == 0)
    all.elasticities = rows.elasticities(table);
  return all;
}

std::function<bool(const RowTable&, std::uint64_t)> stop_rule_of(const StudyFile& study,
                                                                 const SampledStudy& rows) {
  if (study.kind != StudyKind::monte_carlo || !study.sampling.stop)
    return {};
  const StudyStop& stop = *study.sampling.stop;
  StopRule rule{.of = StopRule::Of::mean, .argument = 0.0, .half_width = stop.half_width};
  if (stop.quantile) {
    rule.of = StopRule::Of::quantile;
    rule.argument = *stop.quantile;
  } else if (stop.limit) {
    rule.of = StopRule::Of::exceedance;
    rule.argument = *stop.limit;
  }
  std::uint32_t output = 0;
  while (output < rows.output_columns.size() && rows.output_columns[output].name != stop.output)
    ++output;
  if (output == rows.output_columns.size())
    throw FieldError("sampling.stop.output", stop.output + " is not among the outputs of this study");
  return [rule, output](const RowTable& table, std::uint64_t count) {
    if (!looks_at(rule, count))
      return false;
    std::vector<double> values;
    for (std::uint64_t row = 0; row < count; ++row)
      if (table.status()[row] == row_ok)
        values.push_back(table.value(row, output));
    return reached(rule, values);
  };
}

} // namespace strainwave
