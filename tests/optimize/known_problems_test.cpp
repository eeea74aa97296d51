// Every method on problems with known answers.

#include "optimize/nlopt_search.hpp"
#include "tests/optimize/function_evaluator.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

TEST(Cobyla, FindsTheAnswersOfKnownProblems) {
  for (const KnownProblem& known : known_problems()) {
    FunctionEvaluator evaluator(known.function, known.limits);
    const Problem problem = make_problem(known, evaluator);
    Monitor monitor;
    const auto result = search_nlopt(problem, problem.design().scaled(problem.design().start()),
                                     {.method = "cobyla", .budget = 5000, .tolerance = 1e-7}, monitor);
    EXPECT_TRUE(result.end == SearchEnd::tolerance || known.narrow_valley) << known.name;
    ASSERT_TRUE(result.best) << known.name;
    EXPECT_TRUE(feasible(*result.best)) << known.name;
    // A linear model within a trust region of 1e-7 of the range; valleys bend its path (Rosenbrock).
    EXPECT_NEAR(result.best->objective, known.least, 1e-3 * std::max(1.0, std::abs(known.least)))
        << known.name;
  }
}

TEST(NloptSearch, KeepsToItsBudget) {
  const KnownProblem known = known_problems().front();
  FunctionEvaluator evaluator(known.function, known.limits);
  const Problem problem = make_problem(known, evaluator);
  Monitor monitor;
  const auto result = search_nlopt(problem, problem.design().scaled(problem.design().start()),
                                   {.budget = 17, .tolerance = 1e-9}, monitor);
  EXPECT_EQ(result.end, SearchEnd::budget);
  EXPECT_EQ(result.asked, 17u);
  EXPECT_EQ(evaluator.calls, 17);
}

TEST(NloptSearch, StopsWhenAsked) {
  const KnownProblem known = known_problems().front();
  FunctionEvaluator evaluator(known.function, known.limits);
  const Problem problem = make_problem(known, evaluator);
  Monitor monitor(0, [&] { return evaluator.calls >= 9; });
  const auto result = search_nlopt(problem, problem.design().scaled(problem.design().start()), {}, monitor);
  EXPECT_EQ(result.end, SearchEnd::stopped);
  EXPECT_EQ(evaluator.calls, 9);
  EXPECT_TRUE(result.best);
}

} // namespace
} // namespace strainwave
