#include "strainwave/common/sampling/distribution.hpp"
#include "strainwave/common/sampling/normal_quantile.hpp"
#include "strainwave/common/sampling/sources.hpp"

#include "strainwave/common/sampling/counter_random.hpp"

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace strainwave {
namespace {

TEST(NormalQuantile, AgreesWithBoost) {
  const boost::math::normal normal;
  for (double u : {1e-300, 1e-30, 1e-15, 1e-9, 0.001, 0.0749, 0.0751, 0.3, 0.5, 0.7, 0.925, 0.999, 1 - 1e-12})
    EXPECT_NEAR(normal_quantile(u), boost::math::quantile(normal, u),
                4e-15 * (1 + std::abs(normal_quantile(u))))
        << u;
}

struct Recorded {
  Distribution distribution;
  double values[6];
};

// OpenTURNS 1.20, computeQuantile at the probabilities below; LogNormalMuSigma(2, 0.5, 0) for the lognormal
// one.
TEST(Distribution, QuantilesAreThoseOfOpenTurns) {
  const double p[] = {1e-9, 0.001, 0.2, 0.5, 0.9, 0.9999};
  const Recorded recorded[] = {{Normal{1.5, 0.4},
                                {-0.8991228060030747, 0.2639070775328747, 1.1633515065708342, 1.5,
                                 2.0126206262178403, 2.987606594182271}},
                               {TruncatedNormal{0.3, 1.0, -1.0, 2.0},
                                {-0.9999999949895484, -0.9950057750687891, -0.31727312495537446,
                                 0.3655137258414203, 1.4243661264638785, 1.9990877437954546}},
                               {Triangular{-1.0, 0.5, 2.0},
                                {-0.999932917960675, -0.9329179606750063, -0.05131670194948612, 0.5,
                                 1.3291796067500632, 1.9787867965644048}},
                               {Lognormal{2.0, 0.5},
                                {0.44310468193569, 0.9066088116519851, 1.5771356462917414, 1.9402850002906638,
                                 2.6601416248983387, 4.847841850955242}}};
  for (const Recorded& r : recorded) {
    const Quantile quantile(r.distribution);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(quantile(p[i]), r.values[i], 1e-13 * (1 + std::abs(r.values[i]))) << i;
  }
  EXPECT_NEAR(mean_of(recorded[1].distribution), 0.3900494389102819, 1e-14);
  EXPECT_NEAR(std_of(recorded[1].distribution), 0.739071533729752, 1e-14);
}

// The midpoint rule over the quantile gives mean and standard deviation; its error with 200 000 points is
// below 1e-4 of the spread for all of these (largest for the unbounded ones).
TEST(Distribution, MomentsAreThoseOfTheQuantile) {
  const Distribution all[] = {Normal{1.5, 0.4},    TruncatedNormal{0.3, 1.0, -1.0, 2.0},
                              Uniform{-2.0, 5.0},  Triangular{0.0, 0.0, 3.0},
                              Lognormal{2.0, 0.5}, Tabulated{{0.0, 1.0, 4.0}, {0.0, 0.25, 1.0}}};
  for (const Distribution& d : all) {
    const Quantile quantile(d);
    constexpr int n = 200000;
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < n; ++i) {
      const double x = quantile((i + 0.5) / n);
      sum += x;
      square += x * x;
    }
    const double mean = sum / n, std = std::sqrt(square / n - mean * mean);
    EXPECT_NEAR(mean_of(d), mean, 1e-4 * std) << d.index();
    EXPECT_NEAR(std_of(d), std, 2e-4 * std) << d.index();
  }
}

TEST(Distribution, RefusesNumbersThatMakeNone) {
  const auto message = [](const Distribution& d) -> std::string {
    try {
      check_distribution(d);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message(Normal{0.0, -1.0}), "the standard deviation must be above 0, is -1");
  EXPECT_EQ(message(Uniform{2.0, 1.0}), "lower must be below upper, are 2 and 1");
  EXPECT_EQ(message(Triangular{0.0, 3.0, 1.0}), "the mode must lie between 0 and 1, is 3");
  EXPECT_EQ(message(Tabulated{{0.0, 1.0}, {0.0, 0.9}}),
            "the cumulative shares of a table must run from 0 to 1");
  EXPECT_EQ(message(TruncatedNormal{0.0, 1.0, 7.0, 9.0}),
            "the limits 7 and 9 keep only 1.3e-12 of the distribution");
  EXPECT_EQ(message(Normal{0.0, std::nan("")}), "numbers of a distribution must be finite");
}

// Correlation of n pairs errs by (1 − ρ²)/√n: 0.0045 here, so 5 standard errors are 0.012.
TEST(Correlation, NormalSourcesGetTheCorrelationAskedFor) {
  const double p[] = {1.0, 0.6, 0.6, 1.0};
  const Distribution distributions[] = {Uniform{0.0, 1.0}, Normal{5.0, 2.0}, Normal{-1.0, 0.1}};
  const SourceValues sources(distributions, {{1, GaussianCopula(2, p)}});
  double xy = 0.0, xx = 0.0, yy = 0.0;
  constexpr int n = 20000;
  for (std::uint64_t k = 0; k < n; ++k) {
    double row[3];
    random_uniforms({1, RandomPurpose::samples}, k, row);
    const double u = row[0];
    sources.transform(row);
    EXPECT_EQ(row[0], u);
    const double x = (row[1] - 5.0) / 2.0, y = (row[2] + 1.0) / 0.1;
    xy += x * y;
    xx += x * x;
    yy += y * y;
  }
  EXPECT_NEAR(xy / std::sqrt(xx * yy), 0.6, 0.025);
}

// Uniform margins show the rank correlation: their plain correlation is Spearman's.
TEST(Correlation, RankCorrelationSurvivesOtherDistributions) {
  const double c = normal_correlation_of_rank(-0.5);
  const double p[] = {1.0, c, c, 1.0};
  const Distribution distributions[] = {Uniform{0.0, 1.0}, Uniform{0.0, 1.0}};
  const SourceValues sources(distributions, {{0, GaussianCopula(2, p)}});
  double xy = 0.0;
  constexpr int n = 20000;
  for (std::uint64_t k = 0; k < n; ++k) {
    double row[2];
    random_uniforms({1, RandomPurpose::samples}, k, row);
    sources.transform(row);
    xy += (row[0] - 0.5) * (row[1] - 0.5) * 12.0;
  }
  EXPECT_NEAR(xy / n, -0.5, 0.04);
}

TEST(Correlation, AnImpossibleMatrixIsNamed) {
  const double p[] = {1.0, 0.9, -0.9, 0.9, 1.0, 0.9, -0.9, 0.9, 1.0};
  try {
    const GaussianCopula copula(3, p);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "no such correlation can exist: row 2 contradicts the rows before it");
  }
}

} // namespace
} // namespace strainwave
