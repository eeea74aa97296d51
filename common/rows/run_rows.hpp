#pragma once
// Runs the rows of a plan, or one shard of them, and goes on where an earlier run ended.
//
// Rows are cut into blocks at places fixed by the plan; shard i of n owns the blocks b with b % n = i.
// Threads take blocks in turn, evaluate them and append them to the journal. Whatever decides anything (the
// guard against a study that always fails, the stop rule) looks at the blocks in index order and only at
// their ends, so the result is the same bits for any number of threads, any shards, and after any restart;
// blocks that were evaluated past the end of a stopped study stay in the journal and are left out of the
// table.
//
//     RunResult run = run_rows(plan, inputs, model, file, {.threads = 2, .stop = signalled});
//     return run_exit_code(run.end);

#include "strainwave/common/rows/progress.hpp"
#include "strainwave/common/rows/row_model.hpp"
#include "strainwave/common/rows/row_table.hpp"

#include <chrono>
#include <filesystem>
#include <optional>

namespace strainwave {

struct EnginePlan {
  std::uint64_t rows = 0;
  std::uint32_t block_rows = 1024; ///< 1 for models that take longer than a second
  std::uint32_t shard = 0, shards = 1;
  std::uint64_t plan_hash = 0, model_hash = 0;
  std::string origin; ///< binary and processor, at most 63 bytes
};

struct EngineOptions {
  int threads = 1;
  std::size_t slice_rows = 64;             ///< rows between two looks at the stop flag
  std::optional<double> time_limit_s = {}; ///< wall-clock; then RunEnd::time_limit
  double failure_share = 1.0;              ///< of the rows; more: RunEnd::too_many_failed
  std::uint64_t all_fail_guard =
      20; ///< if the first so many rows all fail, the study ends there; 0: no guard
  /// Looked at after every block in index order with the number of rows so far: true ends the study there.
  /// One shard only.
  std::function<bool(const RowTable&, std::uint64_t rows)> enough = {};
  std::function<bool()> stop = {}; ///< asked some 20 times a second: end early? (a signal has come)
  std::function<void(const RunProgress&)> progress = {}; ///< from the calling thread
  double progress_every_s = 1.0;
  std::chrono::milliseconds sync_every{1000}; ///< of the journal: what a power cut may cost
  /// After a stop, rows in flight may take this long; then the journal is synced and `overdue` is called (a
  /// program may leave there with code 75; if it returns, the run waits on).
  double grace_s = 4.0;
  std::function<void()> overdue = {};
};

enum class RunEnd { complete, enough, time_limit, stopped, all_failed, too_many_failed };

struct RunResult {
  RowTable table; ///< cut at the end that `enough` chose
  RunEnd end = RunEnd::complete;
  RunProgress counts;
  std::string sentence; ///< why, where it is not complete
  std::string damage;   ///< tail of the journal that was cut when it was opened; empty: none
};

/// Throws JournalError, std::system_error (disk), std::invalid_argument (a plan that cannot be), and whatever
/// a model throws; the journal then holds every finished block.
RunResult run_rows(const EnginePlan&, const RowInputs&, const RowModel&, const std::filesystem::path& journal,
                   const EngineOptions&);

/// 0 complete or enough · 3 failures · 75 stopped early.
int run_exit_code(RunEnd);

} // namespace strainwave
