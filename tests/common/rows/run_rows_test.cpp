#include "tests/common/rows/studies_of_numbers.hpp"

#include "strainwave/common/statistics/stop_rule.hpp"

#include <csignal>

namespace strainwave {
namespace {

RunResult run_fresh(const EngineOptions& options, const NumberModel& model = {},
                    EnginePlan plan = number_plan()) {
  const TemporaryFolder folder;
  return run_rows(plan, random_inputs, model, folder.path / "j", options);
}

TEST(RunRows, ThreadsDoNotChangeABit) {
  const RunResult one = run_fresh({.threads = 1});
  EXPECT_EQ(one.end, RunEnd::complete);
  EXPECT_EQ(one.table.done(), 10000U);
  EXPECT_GT(one.table.failed(), 200U);
  for (int threads : {2, 5})
    EXPECT_TRUE(same_rows(one.table, run_fresh({.threads = threads}).table)) << threads;
}

TEST(RunRows, ShardsJoinedAreTheWholeStudy) {
  const RunResult whole = run_fresh({});
  for (std::uint32_t shards : {3U, 64U}) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "shards");
    for (std::uint32_t s = 0; s < shards; ++s) {
      EnginePlan plan = number_plan();
      plan.shard = s;
      plan.shards = shards;
      run_rows(plan, random_inputs, NumberModel{}, shard_journal(folder.path, s, shards), {.threads = 2});
    }
    EXPECT_TRUE(same_rows(whole.table, merge_journals(shard_journals(folder.path)).table)) << shards;
  }
}

TEST(RunRows, SlicesDoNotChangeABit) {
  EXPECT_TRUE(same_rows(run_fresh({.slice_rows = 1}).table, run_fresh({.slice_rows = 1000}).table));
}

TEST(RunRows, ACompleteStudyEvaluatesNothingAgain) {
  const TemporaryFolder folder;
  const NumberModel model;
  const RunResult first = run_rows(number_plan(), random_inputs, model, folder.path / "j", {});
  const NumberModel again;
  const RunResult second = run_rows(number_plan(), random_inputs, again, folder.path / "j", {});
  EXPECT_EQ(again.evaluated, 0U);
  EXPECT_EQ(second.counts.reused, 10000U);
  EXPECT_EQ(second.counts.failed, first.counts.failed);
  EXPECT_TRUE(same_rows(first.table, second.table));
}

TEST(RunRows, TheTimeLimitEndsARunAndTheNextGoesOn) {
  const TemporaryFolder folder;
  NumberModel slow;
  slow.pause = std::chrono::microseconds(200); // 10 000 rows: 2 s at least
  const RunResult first =
      run_rows(number_plan(), random_inputs, slow, folder.path / "j", {.time_limit_s = 0.2});
  EXPECT_EQ(first.end, RunEnd::time_limit);
  EXPECT_EQ(run_exit_code(first.end), 75);
  EXPECT_LT(first.counts.done, 10000U);
  EXPECT_NE(first.sentence.find("stopped early by the time limit"), std::string::npos);
  const RunResult second = run_rows(number_plan(), random_inputs, NumberModel{}, folder.path / "j", {});
  EXPECT_EQ(second.counts.reused, first.counts.done);
  EXPECT_TRUE(same_rows(second.table, run_fresh({}).table));
}

TEST(RunRows, ASignalEndsARunWithASyncedJournal) {
  static volatile std::sig_atomic_t signalled = 0;
  const auto before = std::signal(SIGUSR1, [](int) { signalled = 1; });
  const TemporaryFolder folder;
  NumberModel slow;
  slow.pause = std::chrono::microseconds(500);
  const RunResult run = run_rows(number_plan(), random_inputs, slow, folder.path / "j",
                                 {.threads = 2,
                                  .stop = [] { return signalled != 0; },
                                  .progress = [](const RunProgress&) { std::raise(SIGUSR1); },
                                  .progress_every_s = 0.15});
  std::signal(SIGUSR1, before);
  EXPECT_EQ(run.end, RunEnd::stopped);
  EXPECT_EQ(run_exit_code(run.end), 75);
  const JournalScan scan =
      scan_journal((folder.path / "j").string(), [](RecordKind, std::span<const std::byte>) {});
  EXPECT_EQ(scan.records, run.table.done() / 128);
  EXPECT_TRUE(scan.damage.empty());
}

TEST(RunRows, ARowThatTakesTooLongAfterAStopIsReported) {
  NumberModel stuck;
  stuck.pause = std::chrono::milliseconds(600);
  bool overdue = false;
  EnginePlan plan = number_plan();
  plan.block_rows = 1;
  run_fresh({.time_limit_s = 0.05, .grace_s = 0.1, .overdue = [&] { overdue = true; }}, stuck, plan);
  EXPECT_TRUE(overdue);
}

TEST(RunRows, IfTheFirstTwentyAllFailTheStudyEndsWithTheReason) {
  NumberModel model;
  model.fail_above = -1.0;
  for (int threads : {1, 2}) {
    const RunResult run = run_fresh({.threads = threads}, model);
    EXPECT_EQ(run.end, RunEnd::all_failed);
    EXPECT_EQ(run_exit_code(run.end), 3);
    EXPECT_EQ(
        run.sentence.find("the first 20 rows all failed, 20 of them with status no_wrap; row 0: u0 = 0."), 0U)
        << run.sentence;
    EXPECT_EQ(run.table.rows(), 128U);
  }
}

TEST(RunRows, TheGuardCountsRowsOfSmallBlocksTogether) {
  NumberModel model;
  model.fail_above = -1.0;
  EnginePlan plan = number_plan();
  plan.block_rows = 3;
  EXPECT_EQ(run_fresh({}, model, plan).end, RunEnd::all_failed);
}

TEST(RunRows, MoreFailuresThanTheStudyAllowsEndInThree) {
  const RunResult run = run_fresh({.failure_share = 0.01});
  EXPECT_EQ(run.end, RunEnd::too_many_failed);
  EXPECT_EQ(run_exit_code(run.end), 3);
  EXPECT_EQ(run.table.done(), 10000U);
  EXPECT_NE(run.sentence.find("of 10000 rows failed, more than the share of 0.01 that the study allows"),
            std::string::npos)
      << run.sentence;
}

TEST(RunRows, ANumberThatIsNotFiniteIsAFailedRow) {
  NumberModel model;
  model.nan_at = 77;
  model.fail_above = 2.0;
  const RunResult run = run_fresh({}, model);
  EXPECT_EQ(run.table.failed(), 1U);
  EXPECT_EQ(run.table.status()[77], row_not_finite);
  EXPECT_EQ(run.table.value(77, 0), 0.0);
  EXPECT_EQ(run.table.messages().at(77), "the model gave a number that is not finite");
}

TEST(RunRows, AnExceptionInTheModelKeepsWhatWasDone) {
  const TemporaryFolder folder;
  NumberModel model;
  model.throw_at = 5000;
  EXPECT_THROW(run_rows(number_plan(), random_inputs, model, folder.path / "j", {.threads = 1}),
               std::runtime_error);
  const RunResult run = run_rows(number_plan(), random_inputs, NumberModel{}, folder.path / "j", {});
  EXPECT_EQ(run.counts.reused, 39U * 128U); // blocks before the one with row 5000
  EXPECT_EQ(run.end, RunEnd::complete);
}

EngineOptions stopping_options(int threads) {
  const StopRule rule{.of = StopRule::Of::mean, .half_width = 0.02, .first_look = 128};
  return {.threads = threads, .enough = [rule](const RowTable& table, std::uint64_t rows) {
            if (!looks_at(rule, rows))
              return false;
            std::vector<double> values;
            for (std::uint64_t row = 0; row < rows; ++row)
              if (table.status()[row] == row_ok)
                values.push_back(table.value(row, 0));
            return reached(rule, values);
          }};
}

// Output 0 spreads by about 0.38, so 0.02 asks for some 1400 rows: the look at 2048.
TEST(RunRows, AStopRuleEndsAtTheSameRowForAnyThreadsAndRestarts) {
  const RunResult one = run_fresh(stopping_options(1));
  EXPECT_EQ(one.end, RunEnd::enough);
  EXPECT_EQ(run_exit_code(one.end), 0);
  EXPECT_EQ(one.table.rows(), 2048U);
  EXPECT_TRUE(same_rows(one.table, run_fresh(stopping_options(2)).table));

  const TemporaryFolder folder;
  EngineOptions limited = stopping_options(2);
  limited.time_limit_s = 0.1;
  NumberModel slow;
  slow.pause = std::chrono::microseconds(200);
  EXPECT_EQ(run_rows(number_plan(), random_inputs, slow, folder.path / "j", limited).end, RunEnd::time_limit);
  const RunResult resumed =
      run_rows(number_plan(), random_inputs, NumberModel{}, folder.path / "j", stopping_options(2));
  EXPECT_TRUE(same_rows(one.table, resumed.table));
}

TEST(RunRows, AStopRuleExcludesShards) {
  EnginePlan plan = number_plan();
  plan.shards = 2;
  EXPECT_THROW(run_fresh(stopping_options(1), {}, plan), std::invalid_argument);
}

TEST(RunRows, RefusesShardsThatDoNotExist) {
  EnginePlan plan = number_plan();
  plan.shard = plan.shards = 4;
  try {
    run_fresh({}, {}, plan);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "--shard I/N wants I from 0 to N - 1, got 4/4");
  }
}

} // namespace
} // namespace strainwave
