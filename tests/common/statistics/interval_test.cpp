#include "strainwave/common/statistics/interval.hpp"
#include "strainwave/common/statistics/stop_rule.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace strainwave {
namespace {

// Recorded with OpenTURNS 1.20: Student(15), Binomial(200, 0.95).
TEST(Interval, QuantilesAreThoseOfOpenTurns) {
  EXPECT_NEAR(student_975(15), 2.131449545559776, 1e-12);
  const QuantileRanks ranks = quantile_ranks(0.95, 200);
  EXPECT_LE(ranks.lower, 184U);
  EXPECT_GE(ranks.lower, 183U);
  EXPECT_EQ(ranks.upper, 197U);
}

double log_choose(double n, double k) {
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}
double binomial_probability(double n, double k, double p) {
  return std::exp(log_choose(n, k) + k * std::log(p) + (n - k) * std::log1p(-p));
}

// P(l <= B <= u − 1) summed directly.
TEST(Interval, OrderStatisticsCoverAtLeast95PercentAndNotMuchMore) {
  for (double p : {0.05, 0.5, 0.9, 0.99})
    for (std::uint64_t n : {500, 2000}) {
      const QuantileRanks ranks = quantile_ranks(p, n);
      double covered = 0.0;
      for (std::uint64_t k = ranks.lower; k < ranks.upper; ++k)
        covered += binomial_probability(static_cast<double>(n), static_cast<double>(k), p);
      EXPECT_GE(covered, 0.95) << p << " " << n;
      EXPECT_LE(covered, 0.99) << p << " " << n;
    }
}

TEST(Interval, TooSmallASampleDoesNotBoundAQuantile) {
  EXPECT_EQ(quantile_ranks(0.99, 100).upper, 101U);
}

// Exact coverage for a share of 3 % of 500, summed over the binomial distribution.
TEST(Interval, SharesAreCovered) {
  double wilson = 0.0;
  for (std::uint64_t k = 0; k <= 100; ++k) {
    const double weight = binomial_probability(500, static_cast<double>(k), 0.03);
    wilson += wilson_interval(k, 500).contains(0.03) ? weight : 0.0;
  }
  EXPECT_NEAR(wilson, 0.95, 0.02);
}

TEST(Interval, NoHitsStillHaveAnUpperEnd) {
  EXPECT_EQ(wilson_interval(0, 1000).lower, 0.0);
  const double z2 = normal_975 * normal_975; // (p − 0)² = z² p (1 − p)/n
  EXPECT_NEAR(wilson_interval(0, 1000).upper, z2 / (1000.0 + z2), 1e-15);
}

TEST(StopRule, LooksAtFixedBoundariesThatDouble) {
  const StopRule rule{.first_look = 1024};
  std::vector<std::uint64_t> looks;
  for (std::uint64_t rows = 0; rows <= 10000; rows += 256)
    if (looks_at(rule, rows))
      looks.push_back(rows);
  EXPECT_EQ(looks, (std::vector<std::uint64_t>{1024, 2048, 4096, 8192}));
}

TEST(StopRule, IsReachedWhenTheIntervalIsNarrowEnough) {
  std::vector<double> values; // 0, 1 in turn: the mean's half width is 1.96 · 0.5/√n
  for (int i = 0; i < 10000; ++i)
    values.push_back(i % 2);
  const StopRule rule{.of = StopRule::Of::mean, .half_width = 0.011};
  EXPECT_FALSE(reached(rule, std::span(values).first(5000)));
  EXPECT_TRUE(reached(rule, values));
  EXPECT_FALSE(reached(rule, std::span(values).first(2)));
}

} // namespace
} // namespace strainwave
