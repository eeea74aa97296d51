#include "strainwave/studies/tables/run.hpp"

#include "strainwave/common/files/content_hash.hpp"
#include "strainwave/common/rows/merge.hpp"
#include "strainwave/common/threads/parallel.hpp"
#include "strainwave/studies/tables/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <sys/utsname.h>

namespace strainwave {

namespace {

/// Whom merge names where bits differ: version and processor.
std::string origin() {
  utsname name{};
  const bool known = ::uname(&name) == 0;
  std::string text = fmt::format("{} {} {}", study_version(), __VERSION__, known ? name.machine : "");
  text.resize(std::min<std::size_t>(text.size(), 63));
  return text;
}

std::vector<RowFailures> failures_of(const SampledStudy& rows, const RowTable& table) {
  std::vector<RowFailures> failures;
  for (std::uint64_t row = 0; row < table.rows(); ++row) {
    const std::uint8_t status = table.status()[row];
    if (status == row_ok || status == row_missing)
      continue;
    const std::string name(rows.model->status_name(status));
    auto known = std::ranges::find(failures, name, &RowFailures::status);
    if (known == failures.end()) {
      const auto message = table.messages().find(row);
      known = failures.insert(failures.end(),
                              {name, 0, row, message != table.messages().end() ? message->second : ""});
    }
    ++known->count;
  }
  std::ranges::stable_sort(failures, std::greater{}, &RowFailures::count);
  return failures;
}

} // namespace

std::uint64_t sampled_model_hash(const SampledStudy& rows) {
  return content_hash(std::string(study_version()) + "\n" + rows.model_content);
}

EnginePlan engine_plan(const StudyFile& study, const SampledStudy& rows, std::uint32_t shard,
                       std::uint32_t shards) {
  return {.rows = rows.rows,
          .block_rows = rows.block_rows,
          .shard = shard,
          .shards = shards,
          .plan_hash = plan_hash(study),
          .model_hash = sampled_model_hash(rows),
          .origin = origin()};
}

ResultsTable results_table(const StudyFile& study, const SampledStudy& rows) {
  ResultsTable results;
  results.inputs = rows.input_columns;
  results.outputs = rows.output_columns;
  results.input_rows = rows.input_values;
  results.status_names = rows.status_names;
  results.config = config_text(study);
  results.version = study_version();
  results.plan_hash = plan_hash(study);
  results.model_hash = sampled_model_hash(rows);
  return results;
}

SampledReport report_of(const StudyFile& study, const SampledStudy& rows, const RowTable& table) {
  SampledReport report;
  report.study = study;
  report.input_columns = rows.input_columns;
  report.output_columns = rows.output_columns;
  report.rows = rows.rows;
  report.done = table.done();
  report.failed = table.failed();
  report.failures = failures_of(rows, table);
  report.whole = report.done == rows.rows;
  return report;
}

void write_sampled_results(const ResultFolder& folder, const SampledStudy& rows, const RowTable& table,
                           const SampledReport& report) {
  write_results_table(results_table(report.study, rows), table, folder.path() / "results.h5");
  folder.write_text("result.json", sampled_json(report, folder.path().string()).dump(2) + "\n");
}

void add_answers(SampledReport& report, const RowKind& kind, const SampledStudy& rows,
                 const RowTable& table) {
  report.ranges = output_ranges(rows, table);
  report.answer = kind.answer(report.study, rows, table);
}

Outcome<SampledReport> run_sampled(const StudyFile& study, const RowKind& kind, const ResultFolder& folder,
                                   const SampledOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const RunContext& context = options.context;
  auto made = kind.make_rows(study, context);
  if (!made)
    return made.failure();
  const SampledStudy& rows = *made;
  EngineOptions engine{.threads = usable_threads(context.threads), .slice_rows = rows.slice_rows};
  if (options.time_limit_s) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    engine.time_limit_s = std::max(0.0, *options.time_limit_s - spent.count());
  }
  engine.failure_share = study.limits.failure_share;
  engine.enough = kind.enough(study, rows);
  engine.stop = context.stop;
  engine.progress = options.progress;
  engine.progress_every_s = 0.2;
  engine.overdue = options.overdue;
  const RunResult run = run_rows(engine_plan(study, rows, options.shard, options.shards), rows.inputs,
                                 *rows.model, folder.journal(options.shard, options.shards), engine);
  SampledReport report = report_of(study, rows, run.table);
  report.end = run.end;
  report.sentence = run.sentence;
  report.damage = run.damage;
  report.shard = options.shard;
  report.shards = options.shards;
  report.reused = std::min(run.counts.reused, report.done);
  const bool early = run.end == RunEnd::stopped || run.end == RunEnd::time_limit;
  report.whole = options.shards == 1 && !early && run.end != RunEnd::all_failed;
  if (report.whole)
    add_answers(report, kind, rows, run.table);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  report.seconds = spent.count();
  if (options.shards == 1 && !early)
    write_sampled_results(folder, rows, run.table, report);
  return report;
}

} // namespace strainwave
