#include "strainwave/studies/commands/plan.hpp"

#include "strainwave/common/threads/parallel.hpp"
#include "strainwave/optimize/gear/gear_evaluator.hpp"
#include "strainwave/studies/file/study_gear.hpp"
#include "strainwave/studies/search/optimisation.hpp"
#include "strainwave/studies/tables/row_kind.hpp"

#include <algorithm>
#include <chrono>
#include <sys/resource.h>

namespace strainwave {

namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double peak_memory_bytes() {
  rusage usage{};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * static_cast<double>(usage.ru_maxrss) : 0.0;
}

/// One row, timed.
double evaluate(const SampledStudy& rows, RowWorker& worker, std::uint64_t row, std::size_t count,
                std::vector<std::string>& failures) {
  std::vector<double> inputs(count * rows.model->inputs()), outputs(count * rows.model->outputs(), 0.0);
  std::vector<std::uint8_t> status(count, row_ok);
  std::vector<RowMessage> messages;
  const auto begin = Clock::now();
  rows.inputs(row, count, inputs);
  RowSlice slice{row, count, inputs, outputs, status, &messages, 0};
  worker.evaluate(slice);
  const double seconds = since(begin);
  for (const RowMessage& message : messages)
    failures.push_back(message.text);
  return seconds / static_cast<double>(count);
}

PilotEstimate pilot_rows(const SampledStudy& rows, PilotEstimate e) {
  e.evaluations = rows.rows;
  e.cups = rows.cups;
  const auto worker = rows.model->worker();
  const bool many = rows.block_rows >= 256; // rows of microseconds: timed in blocks
  e.first_s = evaluate(rows, *worker, 0, 1, e.failures);
  const std::uint64_t last = rows.rows - 1;
  const std::size_t count =
      many ? static_cast<std::size_t>(std::min<std::uint64_t>(rows.block_rows, rows.rows)) : 1;
  std::vector<double> times;
  const auto begin = Clock::now();
  for (std::uint64_t k = 1; k <= 200 && (since(begin) < 2.0 || times.size() < 3); ++k) {
    const std::uint64_t row = many ? std::min(k * rows.block_rows, rows.rows - count) : std::min(k, last);
    times.push_back(evaluate(rows, *worker, row, count, e.failures));
    if (row == last || row + count >= rows.rows)
      break;
    if (!many && rows.cups > 1 && k + 1 >= rows.rows / rows.cups)
      break; // the next row would solve another cup
  }
  e.tried = 1 + static_cast<int>(times.size() * count);
  double sum = 0.0;
  for (const double t : times)
    sum += t;
  e.each_s = times.empty() ? e.first_s : sum / static_cast<double>(times.size());
  const auto n = static_cast<double>(rows.rows);
  const double cup_s =
      rows.cups > 1 ? static_cast<double>(rows.cups) * std::max(0.0, e.first_s - e.each_s) : 0.0;
  e.seconds = e.prepare_s + cup_s + n * e.each_s / e.threads;
  const auto outputs = static_cast<double>(rows.output_columns.size());
  const auto inputs = static_cast<double>(rows.input_columns.size());
  const double blocks = n / rows.block_rows + 1.0;
  e.journal_bytes = 128.0 + n * (1.0 + 8.0 * outputs) + 56.0 * blocks;
  e.results_bytes = 16384.0 + n * (1.0 + 8.0 * (inputs + outputs)) + 8.0 * blocks;
  e.memory_bytes = peak_memory_bytes() + n * (1.0 + 16.0 * outputs + 16.0 * inputs) + 8.0 * blocks;
  return e;
}

Outcome<PilotEstimate> pilot_search(const StudyFile& study, PilotEstimate e) {
  const DesignSpace design = study_design(study);
  GearEvaluator model(study.gear, design, study_loads(study), {.disk_cache = false, .threads = e.threads});
  const auto begin = Clock::now();
  const Evaluation baseline = model.evaluate_base();
  e.first_s = since(begin);
  if (!baseline.ok)
    return Failure{Status::contradiction, "the unmodified gear has no result: " + baseline.message};
  std::vector<double> times;
  std::vector<double> x = design.start();
  for (int k = 1; k <= 5; ++k) { // towards the middle of the box: every point is a new one
    for (std::size_t i = 0; i < x.size(); ++i) {
      const DesignVariable& v = design.variables()[i];
      x[i] += 0.15 * (0.5 * (v.lower + v.upper) - x[i]) + (k % 2 ? 0.01 : -0.01) * (v.upper - v.lower);
      x[i] = std::clamp(x[i], v.lower, v.upper);
    }
    const auto start = Clock::now();
    const Evaluation one = model.evaluate(x);
    times.push_back(since(start));
    if (!one.ok)
      e.failures.push_back(one.message);
  }
  std::ranges::sort(times);
  e.each_s = times[times.size() / 2];
  e.tried = 1 + static_cast<int>(times.size());
  e.evaluations = static_cast<std::uint64_t>(study.part<SearchPart>().method.budget);
  const auto n = static_cast<double>(e.evaluations);
  e.seconds = e.first_s +
              n * e.each_s; // searches wait for their own answers: threads help, but nobody knows how much
  const double row = 8.0 * static_cast<double>(gear_responses().size() + design.size());
  const double pieces = 8.0 * static_cast<double>(baseline.pieces.size());
  e.journal_bytes = 128.0 + n * (row + pieces + 200.0);
  e.results_bytes = 16384.0 + n * (row + 9.0);
  e.memory_bytes = peak_memory_bytes() + n * (row + pieces + 500.0);
  return e;
}

} // namespace

Outcome<PilotEstimate> pilot(const StudyFile& study, RunContext context) {
  PilotEstimate e;
  e.threads = usable_threads(context.threads);
  context.disk_cache = false;
  context.warn = {}; // the run says it
  const RowKind* kind = row_kind(study);
  if (!kind)
    return pilot_search(study, e);
  const auto begin = Clock::now();
  auto rows = kind->make_rows(study, context);
  if (!rows)
    return rows.failure();
  e.prepare_s = since(begin);
  return pilot_rows(*rows, e);
}

} // namespace strainwave
