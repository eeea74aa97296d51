#include "strainwave/common/threads/parallel.hpp"

#include "tests/support/child_process.hpp"

#include <atomic>
#include <gtest/gtest.h>
#include <sched.h>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace strainwave {
namespace {

TEST(Parallel, EveryIndexIsWorkedOnce) {
  for (const int threads : {0, 1, 3, 100}) {
    std::vector<std::atomic<int>> times(50);
    parallel_for(times.size(), threads, [&](std::size_t k) { ++times[k]; });
    for (const auto& t : times)
      EXPECT_EQ(t, 1) << threads;
  }
  parallel_for(0, 4, [](std::size_t) { FAIL(); });
}

TEST(Parallel, TheFirstExceptionByIndexComesOutWhenAllAreAtRest) {
  std::atomic<int> running = 0;
  try {
    parallel_for(8, 8, [&](std::size_t k) {
      ++running;
      while (running < 8) // all have begun, so all throw
        std::this_thread::yield();
      throw std::runtime_error(std::to_string(k));
    });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "0");
  }
}

TEST(Parallel, NothingIsBegunAfterAnException) {
  int begun = 0;
  EXPECT_THROW(parallel_for(100, 1,
                            [&](std::size_t k) {
                              ++begun;
                              if (k == 3)
                                throw std::runtime_error("3");
                            }),
               std::runtime_error);
  EXPECT_EQ(begun, 4);
}

TEST(UsableThreads, AreTheCpusOfThisProcess) {
  EXPECT_EQ(usable_threads(7), 7);
  EXPECT_GE(usable_threads(), 1);
  const pid_t child = testing_support::start_child([] {
    cpu_set_t all, one;
    if (sched_getaffinity(0, sizeof all, &all) != 0)
      return 98;
    int cpu = 0;
    while (!CPU_ISSET(cpu, &all))
      ++cpu;
    CPU_ZERO(&one);
    CPU_SET(cpu, &one);
    if (sched_setaffinity(0, sizeof one, &one) != 0)
      return 97;
    return usable_threads();
  });
  EXPECT_EQ(testing_support::end_of_child(child), 1);
}

} // namespace
} // namespace strainwave
