#include "strainwave/common/rows/run_rows.hpp"

#include "strainwave/common/rows/block_order.hpp"
#include "strainwave/common/rows/block_worker.hpp"
#include "strainwave/common/rows/journal_writer.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <fmt/format.h>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace strainwave {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void check(const EnginePlan& plan, const EngineOptions& options) {
  if (plan.rows == 0 || plan.block_rows == 0)
    throw std::invalid_argument("a study needs at least one row");
  if (plan.shards == 0 || plan.shard >= plan.shards)
    throw std::invalid_argument(
        fmt::format("--shard I/N wants I from 0 to N - 1, got {}/{}", plan.shard, plan.shards));
  if (options.enough && plan.shards != 1)
    throw std::invalid_argument(
        "a study that stops by itself cannot be cut into shards: they would not know of each other");
}

class Run {
public:
  Run(const EnginePlan& plan, const RowInputs& inputs, const RowModel& model,
      const std::filesystem::path& journal, const EngineOptions& options)
      : plan_(plan), inputs_(inputs), model_(model), options_(options),
        table_(plan.rows, static_cast<std::uint32_t>(model.outputs()), plan.block_rows),
        order_(plan, options, model, table_),
        journal_(journal.string(), header(), replay(), options.sync_every) {
    for (std::uint64_t b = plan.shard; b < table_.blocks(); b += plan.shards) {
      counts_.total += table_.rows_of_block(b);
      if (!table_.has_block(b))
        todo_.push_back(b);
    }
    counts_.reused = counts_.done = table_.done();
    counts_.failed = table_.failed();
  }

  RunResult run() {
    if (!order_.advance()) {
      std::vector<std::jthread> threads;
      const auto wanted =
          std::min<std::size_t>(static_cast<std::size_t>(std::max(options_.threads, 1)), todo_.size());
      working_ = wanted;
      for (std::size_t i = 0; i < wanted; ++i)
        threads.emplace_back([this] { work(); });
      watch();
    }
    journal_.sync();
    if (error_)
      std::rethrow_exception(error_);
    return result();
  }

private:
  JournalHeader header() const {
    return {plan_.plan_hash, plan_.model_hash, plan_.rows,       plan_.shard,
            plan_.shards,    plan_.block_rows, table_.outputs(), plan_.origin};
  }

  RecordVisitor replay() {
    return [this, block = RowBlock{}](RecordKind kind, std::span<const std::byte> payload) mutable {
      if (kind != RecordKind::rows)
        return;
      decode_block(payload, block);
      if (const auto row = table_.insert(block))
        throw JournalError(JournalFault::contradiction,
                           fmt::format("the journal holds row {} twice with different content", *row));
    };
  }

  void work() noexcept {
    try {
      BlockWorker worker(inputs_, model_, options_.slice_rows, halt_);
      while (!halt_) {
        const std::size_t i = next_.fetch_add(1);
        if (i >= todo_.size())
          break;
        if (!worker.evaluate(todo_[i] * plan_.block_rows, table_.rows_of_block(todo_[i])))
          break;
        journal_.append(RecordKind::rows, worker.record());
        const std::lock_guard lock(mutex_);
        take_in(worker.block());
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_)
        error_ = std::current_exception();
      halt_ = true;
    }
    const std::lock_guard lock(mutex_);
    if (--working_ == 0)
      finished_.notify_all();
  }

  void take_in(const RowBlock& block) {
    table_.insert(block);
    counts_.done += block.rows;
    counts_.failed += static_cast<std::uint64_t>(block.rows - std::ranges::count(block.status, row_ok));
    if (order_.advance())
      halt_ = true;
  }

  /// The calling thread: signals, time limit and progress, until the last worker is done.
  void watch() {
    std::unique_lock lock(mutex_);
    double next_progress = options_.progress_every_s;
    std::optional<double> overdue_at;
    while (working_ > 0) {
      finished_.wait_for(lock, std::chrono::milliseconds(50));
      counts_.seconds = seconds_since(begin_);
      if (!asked_to_stop_ && !order_.ended()) {
        if (options_.stop && options_.stop())
          asked_to_stop_ = RunEnd::stopped;
        else if (options_.time_limit_s && counts_.seconds >= *options_.time_limit_s)
          asked_to_stop_ = RunEnd::time_limit;
        if (asked_to_stop_) {
          halt_ = true;
          overdue_at = counts_.seconds + options_.grace_s;
        }
      }
      const bool report = options_.progress && counts_.seconds >= next_progress;
      const bool overdue = overdue_at && counts_.seconds >= *overdue_at && options_.overdue;
      if (!report && !overdue)
        continue;
      const RunProgress now = counts_;
      lock.unlock();
      if (report) {
        options_.progress(now);
        next_progress = now.seconds + options_.progress_every_s;
      }
      if (overdue) {
        journal_.sync();
        options_.overdue();
        overdue_at.reset();
      }
      lock.lock();
    }
  }

  RunResult result() {
    counts_.seconds = seconds_since(begin_);
    RunResult result{std::move(table_), order_.end(), counts_, order_.sentence(), journal_.found().damage};
    if (!order_.ended()) {
      result.end = asked_to_stop_.value_or(RunEnd::stopped);
      result.sentence = fmt::format("stopped early by {} with {} of {} rows done; run again to go on",
                                    result.end == RunEnd::stopped ? "a signal" : "the time limit",
                                    counts_.done, counts_.total);
      return result;
    }
    result.table.keep_first(order_.end_of_rows());
    const std::uint64_t done = result.table.done(), failed = result.table.failed();
    if (result.end != RunEnd::all_failed &&
        static_cast<double>(failed) > options_.failure_share * static_cast<double>(done)) {
      result.end = RunEnd::too_many_failed;
      result.sentence = fmt::format("{} of {} rows failed, more than the share of {} that the study allows",
                                    failed, done, options_.failure_share);
    }
    return result;
  }

  const EnginePlan& plan_;
  const RowInputs& inputs_;
  const RowModel& model_;
  const EngineOptions& options_;
  Clock::time_point begin_ = Clock::now();
  RowTable table_;
  BlockOrder order_;
  std::vector<std::uint64_t> todo_; ///< blocks, ascending
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> halt_{false};
  std::mutex mutex_; ///< table, order, counts, working, error
  std::condition_variable finished_;
  std::size_t working_ = 0;
  RunProgress counts_;
  std::optional<RunEnd> asked_to_stop_;
  std::exception_ptr error_;
  JournalWriter journal_;
};

} // namespace

RunResult run_rows(const EnginePlan& plan, const RowInputs& inputs, const RowModel& model,
                   const std::filesystem::path& journal, const EngineOptions& options) {
  check(plan, options);
  return Run(plan, inputs, model, journal, options).run();
}

int run_exit_code(RunEnd end) {
  switch (end) {
  case RunEnd::complete:
  case RunEnd::enough:
    return 0;
  case RunEnd::all_failed:
  case RunEnd::too_many_failed:
    return 3;
  case RunEnd::time_limit:
  case RunEnd::stopped:
    break;
  }
  return 75;
}

} // namespace strainwave
