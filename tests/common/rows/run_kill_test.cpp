// A whole run is killed with SIGKILL again and again; what comes out in the end is, bit for bit, the
// uninterrupted study.
#include "tests/common/rows/studies_of_numbers.hpp"

#include <csignal>
#include <sys/wait.h>

namespace strainwave {
namespace {

void kill_runs(int times, std::uint64_t seed) {
  EnginePlan plan = number_plan();
  plan.rows = 400000;
  const TemporaryFolder folder, fresh;
  NumberModel slow;
  slow.pause = std::chrono::microseconds(1);
  int kills = 0;
  for (int i = 0; i < times; ++i) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      run_rows(plan, random_inputs, slow, folder.path / "j",
               {.threads = 2, .sync_every = std::chrono::milliseconds(2)});
      ::_exit(0);
    }
    const std::uint64_t wait =
        random_bits({seed, RandomPurpose::model}, static_cast<std::uint64_t>(i), 0) % 30000;
    std::this_thread::sleep_for(std::chrono::microseconds(wait));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    kills += WIFSIGNALED(status) ? 1 : 0;
  }
  EXPECT_GT(kills, 0);
  const RunResult resumed = run_rows(plan, random_inputs, NumberModel{}, folder.path / "j", {.threads = 2});
  const RunResult whole = run_rows(plan, random_inputs, NumberModel{}, fresh.path / "j", {.threads = 2});
  EXPECT_EQ(resumed.end, RunEnd::complete);
  EXPECT_GT(resumed.counts.reused, 0U);
  EXPECT_LT(resumed.counts.reused, plan.rows);
  EXPECT_TRUE(same_rows(resumed.table, whole.table));
}

TEST(RunKill, TenKillsLeaveTheUninterruptedStudy) {
  kill_runs(10, 3);
}

TEST(RunKillNightly, AHundredKillsLeaveTheUninterruptedStudy) {
  kill_runs(100, 4);
}

} // namespace
} // namespace strainwave
