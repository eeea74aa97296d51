#include "strainwave/common/threads/parallel.hpp"
#include "strainwave/optimize/problem/evaluation_store.hpp"
#include "tests/optimize/function_evaluator.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace strainwave {
namespace {

TEST(EvaluationStore, EveryPointIsEvaluatedOnce) {
  FunctionEvaluator inner([](std::span<const double> x) { return std::vector{2.0 * x[0]}; }, 0);
  EvaluationStore store(inner);
  for (const double x : {1.0, 2.0, 1.0, 1.0})
    EXPECT_EQ(store.evaluate(std::vector{x}).values[0], 2.0 * x);
  EXPECT_EQ(inner.calls, 2);
  EXPECT_EQ(store.counts().done, 2u);
  EXPECT_EQ(store.counts().reused, 2u);
}

TEST(EvaluationStore, NeighbouringNumbersAreDifferentPointsButMinusZeroIsZero) {
  FunctionEvaluator inner([](std::span<const double> x) { return std::vector{x[0]}; }, 0);
  EvaluationStore store(inner);
  for (const double x : {0.0, -0.0, 1.0, 1.0 + 2.3e-16})
    (void)store.evaluate(std::vector{x});
  EXPECT_EQ(inner.calls, 3);
}

TEST(EvaluationStore, FailedEvaluationsAreKeptAndCounted) {
  FunctionEvaluator inner([](std::span<const double>) { return std::vector<double>(); }, 0);
  EvaluationStore store(inner);
  EXPECT_FALSE(store.evaluate(std::vector{1.0}).ok);
  EXPECT_EQ(store.evaluate(std::vector{1.0}).message, "made to fail");
  EXPECT_EQ(inner.calls, 1);
  EXPECT_EQ(store.counts().failed, 1u);
}

TEST(EvaluationStore, ThreadsThatMeetAtAPointShareOneEvaluation) {
  FunctionEvaluator inner(
      [](std::span<const double> x) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        return std::vector{x[0]};
      },
      0);
  EvaluationStore store(inner);
  parallel_for(40, 4, [&](std::size_t k) {
    const double x = static_cast<double>(k % 5);
    EXPECT_EQ(store.evaluate(std::vector{x}).values[0], x);
  });
  EXPECT_EQ(inner.calls, 5);
  EXPECT_EQ(store.counts().done + store.counts().reused, 40u);
}

TEST(EvaluationStore, AnExceptionLeavesThePointOpen) {
  bool broken = true;
  FunctionEvaluator inner(
      [&](std::span<const double> x) {
        if (broken)
          throw std::runtime_error("disk full");
        return std::vector{x[0]};
      },
      0);
  EvaluationStore store(inner);
  EXPECT_THROW((void)store.evaluate(std::vector{1.0}), std::runtime_error);
  broken = false;
  EXPECT_EQ(store.evaluate(std::vector{1.0}).values[0], 1.0);
  EXPECT_EQ(store.points().size(), 1u);
}

TEST(ParallelFor, ThrowsTheFirstExceptionOnWhenAllHaveComeToRest) {
  EXPECT_THROW(parallel_for(8, 3,
                            [](std::size_t k) {
                              if (k == 2)
                                throw std::out_of_range("2");
                            }),
               std::out_of_range);
}

} // namespace
} // namespace strainwave
