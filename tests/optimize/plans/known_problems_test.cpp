// Every method on problems with known answers.

#include "strainwave/optimize/methods/nlopt_methods.hpp"
#include "strainwave/optimize/methods/nlopt_search.hpp"
#include "tests/optimize/function_evaluator.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

SearchResult run(const Problem& problem, const SearchSettings& settings) {
  Monitor monitor;
  return search_nlopt(problem, problem.design().scaled(problem.design().start()), settings, monitor);
}

/// Least f of the box; within `tolerance` of it, relative.
void expect_answer(const KnownProblem& known, const SearchResult& result, double tolerance,
                   std::string_view method) {
  ASSERT_TRUE(result.best) << known.name << ", " << method;
  EXPECT_TRUE(feasible(*result.best)) << known.name << ", " << method;
  EXPECT_NEAR(result.best->objective, known.least, tolerance * std::max(1.0, std::abs(known.least)))
      << known.name << ", " << method << ", " << result.asked << " evaluations";
}

TEST(LocalMethods, FindTheAnswersOfProblemsOfTheirClass) {
  for (const NloptMethod& method : nlopt_method_table()) {
    if (method.global)
      continue;
    for (const KnownProblem& known : known_problems()) {
      const bool of_its_class = known.smooth || method.name == "cobyla" || method.name == "sbplx";
      if (!of_its_class)
        continue;
      FunctionEvaluator evaluator(known.function, known.limits);
      const auto result = run(make_problem(known, evaluator),
                              {.method = std::string(method.name), .budget = 20000, .tolerance = 1e-7});
      expect_answer(known, result, 1e-3, method.name);
    }
  }
}

TEST(GlobalMethods, FindTheDeepestOfSeveralValleys) {
  for (const NloptMethod& method : nlopt_method_table()) {
    if (!method.global)
      continue;
    for (const KnownProblem& known : known_global_problems()) {
      FunctionEvaluator evaluator(known.function, known.limits);
      const auto result = run(make_problem(known, evaluator),
                              {.method = std::string(method.name), .budget = 8000, .tolerance = 1e-6});
      expect_answer(known, result, 0.01, method.name); // the valley counts; a local search goes to its bottom
    }
  }
}

TEST(GlobalMethods, TheSameSeedGivesTheSameSearch) {
  for (const char* method : {"crs2", "isres", "mlsl"}) {
    const KnownProblem known = known_global_problems()[1];
    FunctionEvaluator evaluator(known.function, known.limits);
    const Problem problem = make_problem(known, evaluator);
    const SearchSettings settings{.method = method, .budget = 500, .seed = 11};
    const auto first = run(problem, settings);
    (void)run(problem, {.method = method, .budget = 333, .seed = 12});
    EXPECT_EQ(run(problem, settings).best->y, first.best->y) << method;
  }
}

TEST(SlopeMethods, UseExactGradientsWhereThereAreSome) {
  struct WithGradient : FunctionEvaluator {
    using FunctionEvaluator::FunctionEvaluator;
    std::vector<double> gradient(std::span<const double> x) override {
      ++gradients;
      return {2.0 * (x[0] - 1.0), 20.0 * (x[1] - 2.0), 1.0, 1.0}; // of f, then of g0
    }
    int gradients = 0;
  };
  const KnownProblem known{.name = "quadratic, half plane",
                           .box = {{-5, 5, 4}, {-5, 5, -4}},
                           .function =
                               [](std::span<const double> x) {
                                 return std::vector{(x[0] - 1.0) * (x[0] - 1.0) +
                                                        10.0 * (x[1] - 2.0) * (x[1] - 2.0),
                                                    x[0] + x[1] - 1.9};
                               },
                           .limits = 1,
                           .least = 1.21 / 1.1}; // distance 1.1 from (1, 2), shared 10 : 1
  for (const char* method : {"mma", "ccsaq", "slsqp"}) {
    WithGradient evaluator(known.function, known.limits);
    const auto result =
        run(make_problem(known, evaluator), {.method = method, .budget = 2000, .tolerance = 1e-8});
    expect_answer(known, result, 1e-5, method);
    EXPECT_GT(evaluator.gradients, 0) << method;
    EXPECT_EQ(evaluator.calls, static_cast<int>(result.asked)) << method; // no neighbours
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
