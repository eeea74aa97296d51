// Failure injection: whatever an evaluation does, no method ends `converged` at a wrong point.

#include "strainwave/optimize/methods/ipopt_search.hpp"
#include "strainwave/optimize/plans/optimise.hpp"
#include "tests/optimize/function_evaluator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace strainwave {
namespace {

/// A number in [0, 1) from the bits of a point: the same point fails every time, as real designs do.
double chance(std::span<const double> x, std::uint64_t seed) {
  std::uint64_t hash = 14695981039346656037u + seed;
  for (const double value : x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    hash = (hash ^ bits) * 1099511628211u;
    hash ^= hash >> 31;
  }
  return static_cast<double>(hash >> 11) * 0x1.0p-53;
}

enum class Mishap { failed, not_a_number, infinite };

FunctionEvaluator::Function with_mishaps(const KnownProblem& known, Mishap mishap, double share,
                                         std::uint64_t seed) {
  return [=](std::span<const double> x) {
    auto values = known.function(x);
    if (chance(x, seed) >= share)
      return values;
    if (mishap == Mishap::failed)
      return std::vector<double>();
    values[0] = mishap == Mishap::infinite ? -std::numeric_limits<double>::infinity()
                                           : std::numeric_limits<double>::quiet_NaN();
    return values;
  };
}

class FailureInjection : public testing::TestWithParam<std::string_view> {};

TEST_P(FailureInjection, NothingConvergesAtAWrongPoint) {
  const bool slow = GetParam() == ipopt_method || GetParam() == global_method;
  const std::uint64_t seeds = slow ? 3 : 9;
  int converged = 0;
  for (const KnownProblem& known : known_problems()) {
    for (const Mishap mishap : {Mishap::failed, Mishap::not_a_number, Mishap::infinite}) {
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const double share = seed % 3 == 0 ? 0.5 : seed % 3 == 1 ? 0.1 : 0.01;
        FunctionEvaluator evaluator(with_mishaps(known, mishap, share, seed), known.limits);
        FunctionEvaluator fresh(with_mishaps(known, mishap, share, seed), known.limits);
        const Problem problem = make_problem(known, evaluator);
        Monitor monitor;
        const OptimiseResult result = optimise(
            problem,
            {.search = {.method = std::string(GetParam()), .budget = 2000, .tolerance = 1e-6, .seed = seed}},
            fresh, monitor);
        if (result.judgement.verdict != Verdict::converged)
          continue;
        ++converged;
        EXPECT_NEAR(result.judgement.best->objective, known.least,
                    1e-2 * std::max(1.0, std::abs(known.least)))
            << known.name << ", mishap " << static_cast<int>(mishap) << ", share " << share << ", seed "
            << seed;
      }
    }
  }
  EXPECT_GT(converged, 0); // with one mishap in a hundred some get through
}

TEST_P(FailureInjection, AnExceptionPassesThroughTheLibraryUnharmed) {
  const KnownProblem known = known_problems()[4];
  struct Special : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  for (const int when : {1, 2, 7, 25}) {
    int left = when;
    FunctionEvaluator evaluator(
        [&](std::span<const double> x) {
          if (--left == 0)
            throw Special("out of memory");
          return known.function(x);
        },
        known.limits);
    const Problem problem = make_problem(known, evaluator);
    Monitor monitor;
    EXPECT_THROW((void)optimise(problem, {.search = {.method = std::string(GetParam()), .budget = 500}},
                                evaluator, monitor),
                 Special);
    EXPECT_EQ(evaluator.calls, when); // not once more after that
  }
}

TEST_P(FailureInjection, NothingButFailuresEndsEarlyWithTheReason) {
  const KnownProblem known = known_problems().front();
  FunctionEvaluator evaluator([](std::span<const double>) { return std::vector<double>(); }, known.limits);
  const Problem problem = make_problem(known, evaluator);
  Monitor monitor;
  const OptimiseResult result =
      optimise(problem, {.search = {.method = std::string(GetParam()), .budget = 5000}}, evaluator, monitor);
  EXPECT_EQ(result.judgement.verdict, Verdict::infeasible);
  EXPECT_LE(evaluator.calls, 3 * static_cast<int>(all_failed_limit)); // the survey has three parts
  EXPECT_NE(result.judgement.message.find("made to fail"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Methods, FailureInjection,
                         testing::ValuesIn(method_names().begin(), method_names().end()),
                         [](const auto& method) { return std::string(method.param); });

} // namespace
} // namespace strainwave
