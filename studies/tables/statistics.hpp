#pragma once
// What is asked of a finished table, by the kind of study.

#include "strainwave/common/statistics/morris.hpp"
#include "strainwave/common/statistics/sobol_indices.hpp"
#include "strainwave/common/statistics/stop_rule.hpp"
#include "strainwave/common/statistics/summary.hpp"
#include "strainwave/studies/tables/row_study.hpp"

namespace strainwave {

/// sweep: where an output is least and greatest.
struct OutputRange {
  double least = 0.0, greatest = 0.0;
  std::uint64_t least_row = 0, greatest_row = 0;
};

struct SourceCorrelation {
  std::string input;
  Estimate pearson, spearman; ///< intervals: as for independent samples
};

struct OutputStatistics {
  std::string output, unit;
  std::optional<OutputRange> range;
  std::optional<Summary> summary;              ///< monte_carlo
  std::vector<SourceCorrelation> correlations; ///< monte_carlo
  std::vector<SobolIndices> sobol;             ///< nested sample sizes, the whole sample last
  std::optional<MorrisResult> morris;
  std::string missing; ///< why there is no statistic: too few rows with a result
};

struct SampledStatistics {
  std::vector<OutputStatistics> outputs; ///< in the order of the columns
  std::vector<std::string> index_names;  ///< inputs of sobol and morris
  std::vector<LocalElasticity> elasticities;
};

SampledStatistics statistics_of(const StudyFile& study, const SampledStudy& rows, const RowTable& table);

/// The stop rule of a monte_carlo study, for EngineOptions::enough; empty without `stop`.
std::function<bool(const RowTable&, std::uint64_t)> stop_rule_of(const StudyFile& study,
                                                                 const SampledStudy& rows);

} // namespace strainwave
