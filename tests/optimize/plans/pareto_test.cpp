#include "strainwave/optimize/plans/pareto.hpp"
#include "strainwave/optimize/problem/evaluation_store.hpp"
#include "tests/optimize/function_evaluator.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

using X = std::span<const double>;

/// f = first value; the second aim is g0, without a limit of its own.
std::vector<ParetoPoint> front_of(const FunctionEvaluator::Function& function, const std::vector<Box>& box,
                                  int threads = 1, std::size_t points = 5) {
  FunctionEvaluator evaluator(function, 1), fresh(function, 1);
  EvaluationStore store(evaluator);
  Evaluation baseline;
  baseline.ok = true;
  baseline.values = {1.0, 1.0};
  const Problem problem(box_design(box), store, {.output = "f"}, {}, baseline);
  Monitor monitor;
  // 4000 is on the edge: where ε leaves a single feasible point, whose slopes vanish, a start moved by 1e-9
  // decides whether a share of the budget lets the search come to rest.
  return pareto_front(
      problem, {.output = "g0"},
      {.each = {.search = {.method = std::string(global_method), .budget = 8000, .tolerance = 1e-6},
                .starts = 2,
                .threads = threads},
       .points = points},
      fresh, monitor);
}

TEST(ParetoFront, RunsBetweenTheTwoOptimaOfTwoDistances) {
  // Squared distances from (0, 0) and (1, 0): efficient designs lie on the segment, √f + √g = 1.
  const auto front = front_of(
      [](X x) {
        return std::vector{x[0] * x[0] + x[1] * x[1], (x[0] - 1) * (x[0] - 1) + x[1] * x[1]};
      },
      {{-1, 2, 0.5}, {-1, 1, 0.5}});
  ASSERT_EQ(front.size(), 5u);
  for (std::size_t j = 0; j < front.size(); ++j) {
    const auto& values = front[j].judgement.fresh->values;
    EXPECT_EQ(front[j].judgement.verdict, Verdict::converged) << j << ": " << front[j].judgement.message;
    EXPECT_NEAR(values[1], 1.0 - 0.25 * static_cast<double>(j), 2e-3) << j; // ε evenly from 1 to 0
    EXPECT_NEAR(std::sqrt(values[0]) + std::sqrt(values[1]), 1.0, 3e-3) << j;
  }
}

TEST(ParetoFront, ReachesIntoAHollow) {
  // C. Fonseca and P. Fleming (1995), one variable pair: a concave front, of which weighted sums find the
  // ends only.
  const auto front = front_of(
      [](X x) {
        const double a = 1 / std::sqrt(2.0);
        return std::vector{1 - std::exp(-(x[0] - a) * (x[0] - a) - (x[1] - a) * (x[1] - a)),
                           1 - std::exp(-(x[0] + a) * (x[0] + a) - (x[1] + a) * (x[1] + a))};
      },
      {{-2, 2, 0.3}, {-2, 2, -0.2}});
  ASSERT_EQ(front.size(), 5u);
  for (std::size_t j = 1; j + 1 < front.size(); ++j) {
    const double g = front[j].judgement.fresh->values[1];
    const double t =
        std::sqrt(-std::log(1 - g)) - 1; // along the diagonal: distances 1 − t and 1 + t of the two optima
    EXPECT_NEAR(front[j].judgement.fresh->values[0], 1 - std::exp(-(1 - t) * (1 - t)), 3e-3) << j;
  }
}

TEST(ParetoFront, IsTheSameForAnyNumberOfThreads) {
  const auto function = [](X x) {
    return std::vector{x[0] * x[0] + x[1] * x[1], (x[0] - 1) * (x[0] - 1) + x[1] * x[1]};
  };
  const auto one = front_of(function, {{-1, 2, 0.5}, {-1, 1, 0.5}}, 1, 3);
  const auto two = front_of(function, {{-1, 2, 0.5}, {-1, 1, 0.5}}, 2, 3);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t j = 0; j < one.size(); ++j)
    EXPECT_EQ(one[j].judgement.best->y, two[j].judgement.best->y) << j;
}

} // namespace
} // namespace strainwave
