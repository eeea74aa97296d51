#include "strainwave/optimize/problem/problem.hpp"
#include "tests/optimize/function_evaluator.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace strainwave {
namespace {

Evaluation values(std::vector<double> list) {
  Evaluation evaluation;
  evaluation.ok = true;
  evaluation.values = std::move(list);
  return evaluation;
}

class ProblemOfTwo : public testing::Test {
protected:
  FunctionEvaluator evaluator{[](std::span<const double> x) { return std::vector{x[0], x[0] * x[0]}; }, 1};
  DesignSpace design = box_design({{0, 10, 4}});
  Evaluation baseline = values({50.0, 200.0});

  Problem problem(std::vector<Constraint> constraints, bool maximise = false) {
    return Problem(design, evaluator, {"f", maximise}, constraints, baseline);
  }
};

TEST_F(ProblemOfTwo, ObjectiveIsOneAtTheBaseline) {
  EXPECT_DOUBLE_EQ(problem({}).read(std::vector{0.1}, baseline).objective, 1.0);
  EXPECT_DOUBLE_EQ(problem({}, true).read(std::vector{0.1}, baseline).objective, -1.0);
}

TEST_F(ProblemOfTwo, UnscaledObjectiveIsTheResponseAgain) {
  const Problem largest = problem({}, true);
  EXPECT_DOUBLE_EQ(largest.unscaled_objective(largest.read(std::vector{0.1}, values({30.0, 0.0}))), 30.0);
}

TEST_F(ProblemOfTwo, RatiosBecomeBoundsOfTheBaseline) {
  const Problem p = problem(
      {{.output = "g0", .min = {}, .max = {}, .min_ratio_to_baseline = 0.95, .max_ratio_to_baseline = 1.1}});
  ASSERT_EQ(p.limits().size(), 2u);
  EXPECT_FALSE(p.limits()[0].upper);
  EXPECT_DOUBLE_EQ(p.limits()[0].bound, 190.0);
  EXPECT_TRUE(p.limits()[1].upper);
  EXPECT_DOUBLE_EQ(p.limits()[1].bound, 220.0);
}

TEST_F(ProblemOfTwo, ViolationIsTheLargestScaledExcess) {
  const Problem p = problem({{.output = "g0",
                              .min = 100.0,
                              .max = 400.0,
                              .min_ratio_to_baseline = {},
                              .max_ratio_to_baseline = {}}});
  EXPECT_DOUBLE_EQ(p.read(std::vector{0.1}, values({1.0, 80.0})).violation,
                   0.1); // 20 of 200, the baseline's value
  EXPECT_DOUBLE_EQ(p.read(std::vector{0.1}, values({1.0, 440.0})).violation, 0.1); // 40 of 400, the bound
  EXPECT_EQ(p.read(std::vector{0.1}, values({1.0, 300.0})).violation, 0.0);
}

TEST_F(ProblemOfTwo, RatioToABaselineOfZeroIsRefused) {
  baseline.values[1] = 0.0;
  EXPECT_THROW(problem({{.output = "g0",
                         .min = {},
                         .max = {},
                         .min_ratio_to_baseline = 0.9,
                         .max_ratio_to_baseline = {}}}),
               FieldError);
}

TEST_F(ProblemOfTwo, NumberThatIsNoneCountsAsAFailedEvaluation) {
  const Problem p = problem(
      {{.output = "g0", .min = 0.0, .max = {}, .min_ratio_to_baseline = {}, .max_ratio_to_baseline = {}}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(p.read(std::vector{0.1}, values({nan, 1.0})).ok);
  EXPECT_FALSE(p.read(std::vector{0.1}, values({1.0, nan})).ok);
}

TEST(BetterPoint, FeasibleComesBeforeInfeasibleBeforeFailed) {
  const SearchPoint good{.y = {}, .ok = true, .objective = 5.0, .constraint = {}, .violation = 0.0};
  const SearchPoint worse{.y = {}, .ok = true, .objective = 6.0, .constraint = {}, .violation = 0.0};
  const SearchPoint outside{.y = {}, .ok = true, .objective = 1.0, .constraint = {}, .violation = 0.5};
  const SearchPoint further{.y = {}, .ok = true, .objective = 0.0, .constraint = {}, .violation = 0.6};
  const SearchPoint failed;
  EXPECT_TRUE(better(good, worse));
  EXPECT_TRUE(better(worse, outside));
  EXPECT_TRUE(better(outside, further));
  EXPECT_TRUE(better(further, failed));
  EXPECT_FALSE(better(failed, further));
}

} // namespace
} // namespace strainwave
