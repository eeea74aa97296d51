#pragma once
// Runs a study whose rows are known in advance, or one shard of it: plan, journal, table, statistics, files.

#include "strainwave/common/rows/run_rows.hpp"
#include "strainwave/studies/results/result_folder.hpp"
#include "strainwave/studies/tables/ranges.hpp"
#include "strainwave/studies/tables/row_kind.hpp"

namespace strainwave {

struct SampledOptions {
  RunContext context = {};
  std::uint32_t shard = 0, shards = 1;
  std::optional<double> time_limit_s = {};
  std::function<void(const RunProgress&)> progress = {};
  std::function<void()> overdue = {}; ///< see EngineOptions
};

/// Rows without a result, of one status.
struct RowFailures {
  std::string status;
  std::uint64_t count = 0;
  std::uint64_t example_row = 0;
  std::string example;
};

struct SampledReport {
  StudyFile study;
  std::vector<TableColumn> input_columns, output_columns;
  RunEnd end = RunEnd::complete;
  std::string sentence; ///< why, where it is not complete
  std::string damage;   ///< tail of a journal that was cut
  std::uint32_t shard = 0, shards = 1;
  std::uint64_t rows = 0;   ///< of the whole study
  std::uint64_t done = 0;   ///< rows of the table, failed ones included
  std::uint64_t reused = 0; ///< known from the journal
  std::uint64_t failed = 0;
  std::vector<RowFailures> failures; ///< the most frequent first
  double seconds = 0.0;
  bool whole = false;              ///< every row of the study is in the table, or the stop rule was content
  std::vector<OutputRange> ranges; ///< of a whole table
  std::shared_ptr<const RowAnswer> answer; ///< of a whole table: the kind's own
};

EnginePlan engine_plan(const StudyFile& study, const SampledStudy& rows, std::uint32_t shard,
                       std::uint32_t shards);
std::uint64_t sampled_model_hash(const SampledStudy& rows);
ResultsTable results_table(const StudyFile& study, const SampledStudy& rows);

/// The whole study in one process also writes results.h5 and result.json; a shard writes its journal alone.
/// Throws JournalError, std::system_error, FieldError.
Outcome<SampledReport> run_sampled(const StudyFile& study, const RowKind& kind, const ResultFolder& folder,
                                   const SampledOptions& options);

/// A table that came from elsewhere (merge): report, results.h5 and result.json.
SampledReport report_of(const StudyFile& study, const SampledStudy& rows, const RowTable& table);
/// What a whole table answers.
void add_answers(SampledReport& report, const RowKind& kind, const SampledStudy& rows, const RowTable& table);
void write_sampled_results(const ResultFolder& folder, const SampledStudy& rows, const RowTable& table,
                           const SampledReport& report);

} // namespace strainwave
