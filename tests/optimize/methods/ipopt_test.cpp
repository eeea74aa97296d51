#include "strainwave/optimize/methods/ipopt_search.hpp"
#include "strainwave/optimize/plans/optimise.hpp"
#include "tests/optimize/function_evaluator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strainwave {
namespace {

using X = std::span<const double>;

SearchResult run(const KnownProblem& known, std::size_t pieces, const SearchSettings& settings,
                 int* calls = nullptr) {
  FunctionEvaluator evaluator(known.function, known.limits, pieces);
  const Problem problem = make_problem(known, evaluator);
  Monitor monitor;
  const auto result =
      search_ipopt(problem, problem.design().scaled(problem.design().start()), settings, monitor);
  if (calls)
    *calls = evaluator.calls;
  return result;
}

/// f and its pieces, from the pieces.
std::vector<double> largest_first(std::vector<double> pieces) {
  pieces.insert(pieces.begin(), *std::max_element(pieces.begin(), pieces.end()));
  return pieces;
}

// Problems of L. Lukšan and J. Vlček, Test Problems for Nonsmooth Unconstrained and Linearly Constrained
// Optimization (Prague 2000), with the answers printed there.
const std::vector<std::pair<KnownProblem, std::size_t>> minimax_problems{
    {{.name = "CB2",
      .box = {{-5, 5, 1}, {-5, 5, -0.1}},
      .function =
          [](X x) {
            return largest_first({square(x[0]) + square(square(x[1])), square(2 - x[0]) + square(2 - x[1]),
                                  2 * std::exp(x[1] - x[0])});
          },
      .limits = 0,
      .least = 1.9522245},
     3},
    {{.name = "CB3",
      .box = {{-5, 5, 2}, {-5, 5, 2}},
      .function =
          [](X x) {
            return largest_first({square(square(x[0])) + square(x[1]), square(2 - x[0]) + square(2 - x[1]),
                                  2 * std::exp(x[1] - x[0])});
          },
      .limits = 0,
      .least = 2.0},
     3},
    {{.name = "Rosen-Suzuki as a minimax",
      .box = {{-4, 4, 0}, {-4, 4, 0}, {-4, 4, 0}, {-4, 4, 0}},
      .function =
          [](X x) {
            const double a = x[0] * x[0], b = x[1] * x[1], c = x[2] * x[2], d = x[3] * x[3];
            const double f = a + b + 2 * c + d - 5 * x[0] - 5 * x[1] - 21 * x[2] + 7 * x[3];
            return largest_first({f, f + 10 * (a + b + c + d + x[0] - x[1] + x[2] - x[3] - 8),
                                  f + 10 * (a + 2 * b + c + 2 * d - x[0] - x[3] - 10),
                                  f + 10 * (2 * a + b + c + 2 * x[0] - x[1] - x[3] - 5)});
          },
      .limits = 0,
      .least = -44.0},
     4},
};

class Ipopt : public testing::Test {
protected:
  void SetUp() override {
    if (!ipopt_available())
      GTEST_SKIP() << "built without Ipopt";
  }
};

TEST_F(Ipopt, SolvesMinimaxProblemsByTheirPieces) {
  for (const auto& [known, pieces] : minimax_problems) {
    const auto result = run(known, pieces, {.budget = 3000, .tolerance = 1e-7});
    EXPECT_EQ(result.end, SearchEnd::tolerance) << known.name;
    ASSERT_TRUE(result.best) << known.name;
    EXPECT_NEAR(result.best->objective, known.least, 1e-5 * std::abs(known.least)) << known.name;
  }
}

TEST_F(Ipopt, SolvesSmoothProblemsWithLimits) {
  for (const KnownProblem& known : known_problems()) {
    if (!known.smooth)
      continue;
    const auto result = run(known, 0, {.budget = 5000, .tolerance = 1e-7});
    ASSERT_TRUE(result.best && feasible(*result.best)) << known.name;
    EXPECT_NEAR(result.best->objective, known.least, 1e-4 * std::max(1.0, std::abs(known.least)))
        << known.name;
  }
}

TEST_F(Ipopt, TakesFarFewerEvaluationsWithPiecesThanASimplexWithout) {
  const auto& [known, pieces] = minimax_problems[2];
  int calls = 0;
  (void)run(known, pieces, {.budget = 3000, .tolerance = 1e-5}, &calls);
  EXPECT_LT(calls, 600);
}

TEST_F(Ipopt, PointsKeepTheirBoundsExactly) {
  const KnownProblem known{.name = "slope",
                           .box = {{0, 1, 0.5}, {0, 1, 0.5}},
                           .function = [](X x) { return std::vector{x[0] - 2 * x[1]}; },
                           .limits = 0,
                           .least = -2.0};
  const auto result = run(known, 0, {.budget = 500, .tolerance = 1e-6});
  for (const SearchPoint& point : result.seen)
    for (const double y : point.y)
      EXPECT_TRUE(y >= 0.0 && y <= 1.0) << y;
  EXPECT_NEAR(result.best->objective, known.least, 1e-5);
}

TEST_F(Ipopt, KeepsToItsBudgetAndStopsWhenAsked) {
  int calls = 0;
  EXPECT_EQ(run(known_problems()[0], 0, {.budget = 23, .tolerance = 1e-9}, &calls).end, SearchEnd::budget);
  EXPECT_EQ(calls, 23);
}

TEST_F(Ipopt, SearchesSideBySideDoNotDisturbEachOther) {
  const KnownProblem known = known_problems()[4];
  const auto solve = [&](int threads) {
    FunctionEvaluator evaluator(known.function, known.limits), fresh(known.function, known.limits);
    const Problem problem = make_problem(known, evaluator);
    Monitor monitor;
    return optimise(problem,
                    {.search = {.method = std::string(ipopt_method), .budget = 4000, .tolerance = 1e-6},
                     .starts = 8,
                     .threads = threads},
                    fresh, monitor);
  };
  const auto one = solve(1), four = solve(4);
  EXPECT_EQ(one.judgement.verdict, Verdict::converged) << one.judgement.message;
  EXPECT_EQ(one.found.best->y, four.found.best->y);
  EXPECT_EQ(one.found.asked, four.found.asked);
}

} // namespace
} // namespace strainwave
