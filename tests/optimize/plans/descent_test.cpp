#include "strainwave/optimize/plans/descent.hpp"
#include "tests/optimize/function_evaluator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strainwave {
namespace {

TEST(ShortestInHull, IsZeroWhereTheHullHoldsTheOrigin) {
  const auto v = shortest_in_hull({{1, 0}, {-1, 1}, {-1, -1}});
  EXPECT_NEAR(std::hypot(v[0], v[1]), 0.0, 1e-3); // Frank and Wolfe close in slowly on the inside
}

TEST(ShortestInHull, IsThePerpendicularOntoASegment) {
  const auto v = shortest_in_hull({{2, 0}, {0, 1}});
  EXPECT_NEAR(v[0], 0.4, 1e-9);
  EXPECT_NEAR(v[1], 0.8, 1e-9);
}

/// A ridge along the diagonal, steep across and slowly falling along it: no coordinate leads down.
const KnownProblem ridge{.name = "ridge",
                         .box = {{-1, 1, 0}, {-1, 1, 0}},
                         .function =
                             [](std::span<const double> x) {
                               return std::vector{5.0 * std::abs(x[0] - x[1]) - 0.5 * (x[0] + x[1])};
                             },
                         .limits = 0,
                         .least = -1.0};

std::optional<SearchPoint> look(const KnownProblem& known, const std::vector<double>& x) {
  FunctionEvaluator evaluator(known.function, known.limits);
  const Problem problem = make_problem(known, evaluator);
  const SearchPoint from = problem.at(problem.design().scaled(x));
  return find_descent(problem, from, 0.01, 1, [&](std::span<const double> y) { return problem.at(y); });
}

TEST(FindDescent, SeesTheWayAlongARidge) {
  const auto better_point = look(ridge, {0.0, 0.0});
  ASSERT_TRUE(better_point);
  EXPECT_LT(better_point->objective, -0.005); // a radius of 0.01 of the range 2, slope 1 by each coordinate
}

TEST(FindDescent, SeesNoneAtTheCornerWhereTheRidgeEnds) {
  EXPECT_FALSE(look(ridge, {1.0, 1.0}));
}

TEST(FindDescent, FindsNothingToSpeakOfAtKnownMinima) {
  const KnownProblem minimax = known_problems()[5];
  const auto found = look(minimax, {1.0, 1.0});
  EXPECT_TRUE(!found || found->objective > minimax.least - 1e-9);
  const KnownProblem vertex = known_problems()[2];
  const auto feasible_better = look(vertex, {3.0, std::sqrt(3.0) - 1e-12});
  EXPECT_TRUE(!feasible_better ||
              feasible_better->objective > vertex.least - 1e-5); // within the tolerance of limits
}

TEST(FindDescent, WalksAlongALimitThatIsActive) {
  const KnownProblem known{.name = "walk along a wall",
                           .box = {{-1, 1, 0}, {-1, 1, 0}},
                           .function =
                               [](std::span<const double> x) {
                                 return std::vector{-x[0] - 1.2 * x[1], x[0] + x[1]};
                               },
                           .limits = 1,
                           .least = -0.2}; // at (−1, 1)
  const auto better_point = look(known, {0.0, 0.0});
  ASSERT_TRUE(better_point);
  EXPECT_TRUE(feasible(*better_point));
  EXPECT_LT(better_point->objective, 0.0);
}

} // namespace
} // namespace strainwave
