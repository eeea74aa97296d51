#include "strainwave/common/statistics/association.hpp"
#include "strainwave/common/statistics/summary.hpp"

#include "strainwave/common/sampling/design.hpp"
#include "tests/common/statistics/trials.hpp"

#include <numeric>

namespace strainwave {
namespace {

// Recorded with OpenTURNS 1.20 for x_i = sin i + i/100, y_i = cos 2i + 0.0002 i², i = 1 … 200.
TEST(Summary, AgreesWithOpenTurns) {
  std::vector<double> x, y;
  for (int i = 1; i <= 200; ++i) {
    x.push_back(std::sin(i) + 0.01 * i);
    y.push_back(std::cos(2 * i) + 0.0002 * i * i);
  }
  const Summary sx = summarise(x, {}), sy = summarise(y, {});
  EXPECT_NEAR(sx.mean.value, 1.0051634984180715, 1e-13);
  EXPECT_NEAR(sy.mean.value, 2.6815208365594447, 1e-13);
  EXPECT_NEAR(sx.std.value, 0.9066144729671631, 1e-13);
  EXPECT_NEAR(sy.std.value, 2.501184273892474, 1e-13);
  EXPECT_NEAR(pearson_correlation(x, y).value, 0.5778629244689856, 1e-13);
  EXPECT_NEAR(spearman_of_ranks(ranks_of(x), ranks_of(y)).value, 0.5540178504462612, 1e-13);
}

TEST(Summary, ASmallSampleByHand) {
  const std::vector<double> x{4.0, 1.0, 2.0, 3.0, 5.0};
  const Summary s = summarise(x, {.quantiles = {0.25, 0.6}, .limits = {3.0, 9.0}, .bins = 2});
  EXPECT_EQ(s.mean.value, 3.0);
  EXPECT_DOUBLE_EQ(s.std.value, std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(s.quantiles[0].estimate.value, 2.0);
  EXPECT_DOUBLE_EQ(s.quantiles[1].estimate.value, 3.4);
  EXPECT_DOUBLE_EQ(s.exceedances[0].probability.value, 0.4);
  EXPECT_EQ(s.exceedances[1].probability.value, 0.0);
  EXPECT_EQ(s.histogram.counts, (std::vector<std::uint64_t>{2, 3}));
  EXPECT_THROW(summarise(std::vector<double>{1.0, 2.0, 3.0}, {}), std::invalid_argument);
}

TEST(Summary, AConstantOutputHasNoSpreadAndNoCorrelation) {
  const std::vector<double> x(100, 0.1), y = normals(1, 100);
  const Summary s = summarise(x, {});
  EXPECT_EQ(s.std.ci95.upper, 0.0);
  EXPECT_EQ(s.histogram.counts[0], 100U);
  EXPECT_EQ(pearson_correlation(x, y).value, 0.0);
}

TEST(Ranks, TiesShareTheirMeanRank) {
  EXPECT_EQ(ranks_of(std::vector<double>{2.0, 1.0, 2.0, 7.0}), (std::vector<double>{2.5, 1.0, 2.5, 4.0}));
}

// y = 3 + Σ a_j z_j, a = (1, −2, 0.5): mean 3, variance 5.25, quantiles and exceedances of the normal
// distribution, correlation a_j/√5.25.
const double slopes[] = {1.0, -2.0, 0.5};
const double spread = std::sqrt(5.25);

double linear(std::span<const double> uniforms) {
  double y = 3.0;
  for (std::size_t j = 0; j < 3; ++j)
    y += slopes[j] * normal_quantile(uniforms[j]);
  return y;
}

void cover_random(int trials, double tolerance) {
  Coverage coverage(7);
  for (int t = 0; t < trials; ++t) {
    constexpr std::size_t n = 1000;
    const SampleDesign design({.seed = static_cast<std::uint64_t>(t), .samples = n, .dimensions = 3});
    std::vector<double> u(3 * n), y(n), first(n);
    design.points(0, n, u);
    for (std::size_t i = 0; i < n; ++i) {
      y[i] = linear(std::span(u).subspan(3 * i, 3));
      first[i] = normal_quantile(u[3 * i]);
    }
    const Summary s = summarise(y, {.quantiles = {0.5, 0.95}, .limits = {3.0 + 1.5 * spread}});
    coverage.add(0, s.mean, 3.0);
    coverage.add(1, s.std, spread);
    coverage.add(2, s.quantiles[0].estimate, 3.0);
    coverage.add(3, s.quantiles[1].estimate, 3.0 + spread * normal_quantile(0.95));
    coverage.add(4, s.exceedances[0].probability, normal_cdf(-1.5));
    coverage.add(5, pearson_correlation(first, y), slopes[0] / spread);
    // Spearman's of a normal pair: (6/π) asin(ρ/2).
    coverage.add(6, spearman_of_ranks(ranks_of(first), ranks_of(y)),
                 6.0 / 3.14159265358979 * std::asin(0.5 * slopes[0] / spread));
  }
  coverage.expect(trials, tolerance);
}

TEST(SummaryCoverage, IndependentSamplesOfALinearGaussianCase) {
  cover_random(150, coverage_tolerance(150));
}
TEST(SummaryCoverageNightly, IndependentSamplesOfALinearGaussianCase) {
  cover_random(1000, 0.02);
}

void cover_randomised(SamplingDesign kind, int trials, double tolerance) {
  Coverage coverage(4);
  for (int t = 0; t < trials; ++t) {
    constexpr std::size_t n = 2048, r = 16;
    const SampleDesign design({.design = kind,
                               .seed = 1000 + static_cast<std::uint64_t>(t),
                               .samples = n,
                               .dimensions = 3,
                               .randomisations = r});
    std::vector<double> u(3 * n), y(n);
    design.points(0, n, u);
    for (std::size_t i = 0; i < n; ++i)
      y[i] = linear(std::span(u).subspan(3 * i, 3)) + 0.3 * u[3 * i] * u[3 * i + 1]; // not quite linear
    std::vector<std::span<const double>> parts;
    for (std::size_t i = 0; i < r; ++i)
      parts.push_back(std::span(y).subspan(i * n / r, n / r));
    const Summary s = summarise_randomised(parts, {.quantiles = {0.5}, .limits = {3.0 + 1.5 * spread}});
    coverage.add(0, s.mean, 3.0 + 0.3 * 0.25);
    // Standard deviation, median and share of the slightly bent case: from 2^20 Sobol' points (error below
    // 1e-4 of the spread).
    static const Summary truth = [] {
      const SampleDesign fine(
          {.design = SamplingDesign::sobol, .seed = 5, .samples = 1 << 20, .dimensions = 3});
      std::vector<double> v(3 << 20), z(1 << 20);
      fine.points(0, 1 << 20, v);
      for (std::size_t i = 0; i < z.size(); ++i)
        z[i] = linear(std::span(v).subspan(3 * i, 3)) + 0.3 * v[3 * i] * v[3 * i + 1];
      return summarise(z, {.quantiles = {0.5}, .limits = {3.0 + 1.5 * spread}});
    }();
    coverage.add(1, s.std, truth.std.value);
    coverage.add(2, s.quantiles[0].estimate, truth.quantiles[0].estimate.value);
    coverage.add(3, s.exceedances[0].probability, truth.exceedances[0].probability.value);
  }
  coverage.expect(trials, tolerance);
}

TEST(SummaryCoverage, LatinHypercubesFromTheirRandomisations) {
  cover_randomised(SamplingDesign::latin_hypercube, 150, coverage_tolerance(150));
}
TEST(SummaryCoverage, SobolDesignsFromTheirRandomisations) {
  cover_randomised(SamplingDesign::sobol, 150, coverage_tolerance(150));
}
TEST(SummaryCoverageNightly, LatinHypercubesFromTheirRandomisations) {
  cover_randomised(SamplingDesign::latin_hypercube, 1000, 0.02);
}
TEST(SummaryCoverageNightly, SobolDesignsFromTheirRandomisations) {
  cover_randomised(SamplingDesign::sobol, 1000, 0.02);
}

} // namespace
} // namespace strainwave
