// Memory by input: once for each key, and nobody waits for another key. Latches order the threads; nothing
// here depends on time.

#include "strainwave/common/threads/content_key.hpp"
#include "strainwave/common/threads/memo.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <latch>
#include <stdexcept>
#include <thread>
#include <vector>

namespace strainwave {
namespace {

TEST(Memo, ManyThreadsThatAskForOneKeyShareOneValue) {
  constexpr int threads = 8;
  Memo<int, int> memo(4);
  std::atomic<int> computed = 0, reused = 0;
  std::latch all(threads);
  std::vector<std::shared_ptr<const int>> got(threads);
  {
    std::vector<std::jthread> running;
    for (int t = 0; t < threads; ++t)
      running.emplace_back([&, t] {
        all.arrive_and_wait();
        const auto found = memo.get(7, [&] { return 100 + ++computed; });
        reused += found.reused;
        got[static_cast<std::size_t>(t)] = found.value;
      });
  }
  EXPECT_EQ(computed, 1);
  EXPECT_EQ(reused, threads - 1);
  for (const auto& value : got)
    EXPECT_EQ(value, got.front());
  EXPECT_EQ(*got.front(), 101);
}

TEST(Memo, OneWhoAsksWhileAnotherComputesWaitsForThatValue) {
  Memo<int, int> memo(4);
  std::latch computing(1), go_on(1);
  int computed = 0;
  std::jthread first([&] {
    memo.get(1, [&] {
      computing.count_down();
      go_on.wait();
      return ++computed;
    });
  });
  computing.wait();
  std::shared_ptr<const int> second;
  std::jthread waits([&] { second = memo.get(1, [&] { return ++computed; }).value; });
  go_on.count_down();
  waits.join();
  first.join();
  EXPECT_EQ(computed, 1);
  EXPECT_EQ(*second, 1);
}

TEST(Memo, DifferentKeysAreComputedAtTheSameTime) {
  Memo<int, int> memo(4);
  std::latch both_inside(2); // under one lock the second would never get inside
  std::jthread one([&] {
    memo.get(1, [&] {
      both_inside.arrive_and_wait();
      return 1;
    });
  });
  memo.get(2, [&] {
    both_inside.arrive_and_wait();
    return 2;
  });
  one.join();
  EXPECT_TRUE(memo.get(1, [] { return 0; }).reused);
}

TEST(Memo, TheLeastRecentlyAskedForGoesFirst) {
  Memo<int, int> memo(2);
  const auto ask = [&](int key) { return memo.get(key, [&] { return key; }).reused; };
  EXPECT_FALSE(ask(1));
  EXPECT_FALSE(ask(2));
  EXPECT_TRUE(ask(1));
  EXPECT_FALSE(ask(3)); // 2 goes
  EXPECT_TRUE(ask(1));
  EXPECT_FALSE(ask(2));
}

TEST(Memo, AValueLivesAsLongAsItIsHeld) {
  Memo<int, std::vector<int>> memo(1);
  const auto held = memo.get(1, [] { return std::vector{1, 2, 3}; }).value;
  memo.get(2, [] { return std::vector{4}; });
  EXPECT_EQ(*held, (std::vector{1, 2, 3}));
}

TEST(Memo, AnExceptionReachesThoseWhoWaitAndIsNotRemembered) {
  Memo<int, int> memo(4);
  std::latch computing(1), go_on(1);
  int thrown = 0;
  std::jthread first([&] {
    try {
      memo.get(1, [&]() -> int {
        computing.count_down();
        go_on.wait();
        throw std::runtime_error("disk full");
      });
    } catch (const std::runtime_error&) {
      ++thrown;
    }
  });
  computing.wait();
  go_on.count_down();
  first.join();
  EXPECT_EQ(thrown, 1);
  EXPECT_EQ(*memo.get(1, [] { return 5; }).value, 5);
}

TEST(ContentKey, HoldsExactBitsAndKnowsNoMinusZero) {
  EXPECT_EQ(ContentKey().add(0.0), ContentKey().add(-0.0));
  EXPECT_NE(ContentKey().add(0.1), ContentKey().add(std::nextafter(0.1, 1.0)));
  EXPECT_NE(ContentKey().add("ab").add("c"), ContentKey().add("a").add("bc"));
}

} // namespace
} // namespace strainwave
