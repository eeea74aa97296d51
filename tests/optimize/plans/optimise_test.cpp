// The whole: starts, searches, confirmation, verdict.

#include "strainwave/optimize/plans/global_then_polish.hpp"
#include "strainwave/optimize/plans/optimise.hpp"
#include "strainwave/optimize/problem/evaluation_store.hpp"
#include "tests/optimize/function_evaluator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace strainwave {
namespace {

OptimiseResult solve(const KnownProblem& known, OptimiseSettings settings) {
  FunctionEvaluator evaluator(known.function, known.limits);
  FunctionEvaluator fresh(known.function, known.limits);
  EvaluationStore store(evaluator);
  const Problem problem = make_problem(known, store);
  Monitor monitor;
  return optimise(problem, settings, fresh, monitor);
}

TEST(Optimise, ConvergesOnKnownProblems) {
  for (const KnownProblem& known : known_problems()) {
    const auto result = solve(known, {.search = {.budget = 8000, .tolerance = 1e-6}});
    if (known.narrow_valley)
      continue; // ends by budget
    EXPECT_EQ(result.judgement.verdict, Verdict::converged) << known.name << ": " << result.judgement.message;
    EXPECT_NEAR(result.judgement.best->objective, known.least, 2e-3 * std::max(1.0, std::abs(known.least)))
        << known.name;
  }
}

TEST(Optimise, TooSmallABudgetIsSaidSo) {
  EXPECT_EQ(solve(known_problems()[0], {.search = {.budget = 30}}).judgement.verdict, Verdict::budget);
}

TEST(Optimise, LimitsThatNothingKeepsAreInfeasibleWithTheLeastViolation) {
  KnownProblem known = known_problems()[0];
  known.function = [](std::span<const double> x) {
    return std::vector{x[1], 3.0 - x[0]};
  }; // x0 ≥ 3, but x0 ≤ 2
  known.limits = 1;
  const auto result = solve(known, {.search = {.budget = 500}});
  EXPECT_EQ(result.judgement.verdict, Verdict::infeasible);
  EXPECT_NEAR(result.judgement.best->violation, 1.0, 1e-3);
  EXPECT_NE(result.judgement.message.find("g0 is 1 and has to be at most 0"), std::string::npos)
      << result.judgement.message;
}

TEST(Optimise, ResultIsTheSameForAnyNumberOfThreads) {
  const KnownProblem wavy{
      .name = "many valleys", .box = {{-3, 3, 2.2}, {-3, 3, 2.2}}, .function = [](std::span<const double> x) {
        double f = 0.0;
        for (const double a : x)
          f += a * a - 10.0 * std::cos(2.0 * std::numbers::pi * a);
        return std::vector{f};
      }};
  const auto one = solve(wavy, {.search = {.budget = 3000, .seed = 5}, .starts = 12, .threads = 1});
  const auto four = solve(wavy, {.search = {.budget = 3000, .seed = 5}, .starts = 12, .threads = 4});
  ASSERT_TRUE(one.found.best && four.found.best);
  EXPECT_EQ(one.found.best->y, four.found.best->y);
  EXPECT_EQ(one.found.asked, four.found.asked);
  EXPECT_EQ(one.judgement.verdict, four.judgement.verdict);
  const auto alone = solve(wavy, {.search = {.budget = 3000, .seed = 5}});
  EXPECT_LT(one.found.best->objective,
            alone.found.best->objective); // the start's own valley is not the deepest
}

TEST(Optimise, NeverEndsBelowADesignThatIsKnown) {
  const KnownProblem two_valleys{
      .name = "two valleys",
      .box = {{-3, 3, 2}},
      .function =
          [](std::span<const double> x) { return std::vector{(x[0] * x[0] - 4) * (x[0] * x[0] - 4) + x[0]}; },
      .limits = 0,
      .least = -2.0156}; // near −2; the start lies in the other one
  OptimiseSettings settings{.search = {.budget = 400, .first_step = 0.02}};
  EXPECT_GT(solve(two_valleys, settings).judgement.best->objective, 1.0);
  settings.known = {{1.1 / 6.0}}; // x = −1.9
  const auto result = solve(two_valleys, settings);
  EXPECT_EQ(result.judgement.verdict, Verdict::converged);
  EXPECT_NEAR(result.judgement.best->objective, two_valleys.least, 1e-3);
}

TEST(GlobalThenPolish, FindsTheBottomOfTheDeepestValley) {
  for (const KnownProblem& known : known_global_problems()) {
    const auto result =
        solve(known, {.search = {.method = std::string(global_method), .budget = 2000, .tolerance = 1e-6},
                      .starts = 4});
    EXPECT_EQ(result.judgement.verdict, Verdict::converged) << known.name << ": " << result.judgement.message;
    EXPECT_NEAR(result.judgement.best->objective, known.least, 1e-5 * std::max(1.0, std::abs(known.least)))
        << known.name;
    EXPECT_LE(result.found.asked, 2000u);
  }
}

TEST(GlobalThenPolish, IsTheSameForAnyNumberOfThreads) {
  const KnownProblem known = known_global_problems()[1];
  OptimiseSettings settings{.search = {.method = std::string(global_method), .budget = 600, .seed = 3},
                            .starts = 5};
  settings.threads = 1;
  const auto one = solve(known, settings);
  settings.threads = 3;
  const auto three = solve(known, settings);
  EXPECT_EQ(one.found.best->y, three.found.best->y);
  EXPECT_EQ(one.found.asked, three.found.asked);
}

TEST(BestApart, TakesTheBestOfEveryNeighbourhood) {
  FunctionEvaluator evaluator([](std::span<const double> x) { return std::vector{x[0]}; }, 0);
  const Problem problem = make_problem({.name = "", .box = {{0, 10, 5}}, .function = {}}, evaluator);
  std::vector<SearchPoint> points;
  for (const double x : {5.0, 1.0, 1.2, 5.3, 9.0})
    points.push_back(problem.at(problem.design().scaled(std::vector{x})));
  const auto best = best_apart(problem, points, 3, 0.1);
  ASSERT_EQ(best.size(), 3u);
  EXPECT_DOUBLE_EQ(best[0].objective, 1.0);
  EXPECT_DOUBLE_EQ(best[1].objective, 5.0);
  EXPECT_DOUBLE_EQ(best[2].objective, 9.0);
}

TEST(Verdict, AnOptimumThatTheFreshEvaluationContradictsDoesNotStand) {
  const KnownProblem known = known_problems()[3];
  FunctionEvaluator evaluator(known.function, known.limits);
  FunctionEvaluator poisoned(
      [&](std::span<const double> x) {
        auto values = known.function(x);
        values[0] += 1e-9;
        return values;
      },
      known.limits);
  const Problem problem = make_problem(known, evaluator);
  Monitor monitor;
  const auto result = optimise(problem, {.search = {.budget = 3000}}, poisoned, monitor);
  EXPECT_EQ(result.judgement.verdict, Verdict::stalled);
  EXPECT_NE(result.judgement.message.find("other numbers"), std::string::npos);
}

TEST(Verdict, AnOptimumThatFailsWhenEvaluatedAgainDoesNotStand) {
  const KnownProblem known = known_problems()[3];
  FunctionEvaluator evaluator(known.function, known.limits);
  FunctionEvaluator failing([](std::span<const double>) { return std::vector<double>(); }, known.limits);
  const Problem problem = make_problem(known, evaluator);
  Monitor monitor;
  EXPECT_EQ(optimise(problem, {.search = {.budget = 3000}}, failing, monitor).judgement.verdict,
            Verdict::stalled);
}

TEST(Verdict, ResidualsThatAreTooLargeDoNotStand) {
  struct BadCertificate : FunctionEvaluator {
    using FunctionEvaluator::FunctionEvaluator;
    Evaluation evaluate(std::span<const double> x) override {
      Evaluation evaluation = FunctionEvaluator::evaluate(x);
      evaluation.certificate.equilibrium = 1e-3;
      return evaluation;
    }
  };
  const KnownProblem known = known_problems()[3];
  BadCertificate evaluator(known.function, known.limits);
  const Problem problem = make_problem(known, evaluator);
  Monitor monitor;
  const auto result = optimise(problem, {.search = {.budget = 3000}}, evaluator, monitor);
  EXPECT_EQ(result.judgement.verdict, Verdict::stalled);
  EXPECT_NE(result.judgement.message.find("residuals"), std::string::npos);
}

TEST(Verdict, AMethodThatIsContentAtAWrongPointIsFoundOut) {
  // A search that claims to be done on a slope: the confirmation walks on downhill and says what it found.
  const KnownProblem known = known_problems()[3];
  FunctionEvaluator evaluator(known.function, known.limits);
  const Problem problem = make_problem(known, evaluator);
  Monitor monitor;
  SearchResult claimed;
  claimed.end = SearchEnd::tolerance;
  claimed.best = problem.at(problem.design().scaled(problem.design().start()));
  const double before = claimed.best->objective;
  const bool confirmed = confirm(problem, claimed, {.tolerance = 1e-6}, 2000, monitor);
  EXPECT_TRUE(confirmed);
  EXPECT_LT(claimed.best->objective, before - 1.0);
  EXPECT_NEAR(claimed.best->objective, known.least, 1e-4);
}

} // namespace
} // namespace strainwave
