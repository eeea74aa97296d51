#include "strainwave/common/statistics/sobol_indices.hpp"

#include "tests/common/statistics/trials.hpp"
#include "tests/support/saltelli_points.hpp"

#include <functional>
#include <numbers>

namespace strainwave {
namespace {

using testing_support::SaltelliPoints;

constexpr double pi = std::numbers::pi;
using Function = std::function<double(std::span<const double>)>;

/// Ishigami and Homma (1990), a = 7, b = 0.1, inputs uniform on (−π, π).
double ishigami(std::span<const double> u) {
  double x[3];
  for (std::size_t i = 0; i < 3; ++i)
    x[i] = pi * (2.0 * u[i] - 1.0);
  return std::sin(x[0]) + 7.0 * std::pow(std::sin(x[1]), 2) + 0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}
struct Known {
  std::vector<double> first, total;
};
Known ishigami_indices() {
  const double a = 7.0, b = 0.1, pi4 = std::pow(pi, 4), pi8 = pi4 * pi4;
  const double v1 = 0.5 * std::pow(1.0 + b * pi4 / 5.0, 2), v2 = a * a / 8.0, v13 = b * b * pi8 * 8.0 / 225.0;
  const double v = v1 + v2 + v13;
  return {{v1 / v, v2 / v, 0.0}, {(v1 + v13) / v, v2 / v, v13 / v}};
}

/// g-function of Sobol': Π (|4 u_i − 2| + a_i)/(1 + a_i), V_i = 1/(3 (1 + a_i)²).
const double g_weights[] = {0.0, 1.0, 4.5, 9.0, 99.0};
double g_function(std::span<const double> u) {
  double product = 1.0;
  for (std::size_t i = 0; i < 5; ++i)
    product *= (std::abs(4.0 * u[i] - 2.0) + g_weights[i]) / (1.0 + g_weights[i]);
  return product;
}
Known g_indices() {
  double all = 1.0;
  for (double a : g_weights)
    all *= 1.0 + 1.0 / (3.0 * (1.0 + a) * (1.0 + a));
  Known known;
  for (double a : g_weights) {
    const double v = 1.0 / (3.0 * (1.0 + a) * (1.0 + a));
    known.first.push_back(v / (all - 1.0));
    known.total.push_back(v * all / (1.0 + v) / (all - 1.0));
  }
  return known;
}

std::vector<double> evaluate(const SaltelliPoints& points, const Function& f) {
  std::vector<double> u(points.rows() * points.inputs()), y(points.rows());
  points.points(0, points.rows(), u);
  for (std::uint64_t k = 0; k < points.rows(); ++k)
    y[k] = f(std::span(u).subspan(k * points.inputs(), points.inputs()));
  return y;
}

SobolIndices indices_of(const SaltelliPoints& points, const Function& f) {
  const std::vector<double> y = evaluate(points, f);
  return sobol_indices(y, std::vector<std::uint8_t>(y.size(), 0), points.inputs());
}

void expect_close(const SobolIndices& found, const Known& known, double tolerance) {
  for (std::size_t i = 0; i < known.first.size(); ++i) {
    EXPECT_NEAR(found.inputs[i].first.value, known.first[i], tolerance) << i;
    EXPECT_NEAR(found.inputs[i].total.value, known.total[i], tolerance) << i;
  }
}

TEST(SobolIndices, IshigamiAgreesWithItsClosedForm) {
  expect_close(indices_of(SaltelliPoints(SamplingDesign::sobol, 1, 3, 8192), ishigami), ishigami_indices(),
               0.005);
}

TEST(SobolIndices, TheGFunctionAgreesWithItsClosedForm) {
  expect_close(indices_of(SaltelliPoints(SamplingDesign::sobol, 1, 5, 8192), g_function), g_indices(), 0.005);
}

// y = Σ a_i z_i: first and total index are both a_i²/Σ a².
TEST(SobolIndices, ALinearGaussianCaseHasNoInteractions) {
  const double a[] = {1.0, -2.0, 0.5};
  const auto f = [&](std::span<const double> u) {
    return a[0] * normal_quantile(u[0]) + a[1] * normal_quantile(u[1]) + a[2] * normal_quantile(u[2]);
  };
  const Known known{{1.0 / 5.25, 4.0 / 5.25, 0.25 / 5.25}, {1.0 / 5.25, 4.0 / 5.25, 0.25 / 5.25}};
  expect_close(indices_of(SaltelliPoints(SamplingDesign::sobol, 1, 3, 8192), f), known, 0.01);
}

// JansenSensitivityAlgorithm of OpenTURNS 1.20 on 64 blocks of the lattice u_j = frac((j + 1) g): its totals
// are divided by the variance of A alone, and its sum by 127 instead of 128.
TEST(SobolIndices, TotalsAreThoseOfOpenTurns) {
  const double g[] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703, 0.4503,
                      0.3688787,          0.3021754};
  const double totals[] = {0.362202710522375, 0.39133524879157033, 0.23640588142484428};
  const double variance_of_a = 15.512413765329232;
  std::vector<double> y;
  for (int j = 0; j < 64; ++j) {
    double u[6];
    for (int d = 0; d < 6; ++d)
      u[d] = std::fmod((j + 1) * g[d], 1.0);
    y.push_back(ishigami(std::span(u).first(3)));
    y.push_back(ishigami(std::span(u).last(3)));
    for (std::size_t i = 0; i < 3; ++i) {
      double c[3] = {u[0], u[1], u[2]};
      c[i] = u[3 + i];
      y.push_back(ishigami(c));
    }
  }
  const SobolIndices found = sobol_indices(y, std::vector<std::uint8_t>(y.size(), 0), 3);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(found.inputs[i].total.value * found.variance, totals[i] * variance_of_a * 127.0 / 128.0,
                1e-12);
}

TEST(SobolIndices, ABlockWithAFailedRowIsDroppedWholeAndCounted) {
  const SaltelliPoints points(SamplingDesign::sobol, 1, 3, 64);
  std::vector<double> y = evaluate(points, ishigami);
  std::vector<std::uint8_t> status(y.size(), 0);
  status[7] = 3; // block 1
  status[9] = 3; // block 1 again
  status[5 * 63] = 1;
  y[7] = y[9] = y[5 * 63] = 1e300; // must not be read
  const SobolIndices found = sobol_indices(y, status, 3);
  EXPECT_EQ(found.blocks, 62U);
  EXPECT_EQ(found.dropped_blocks, 2U);
  std::vector<double> rest;
  for (std::uint64_t b = 0; b < 63; ++b)
    if (b != 1)
      rest.insert(rest.end(), y.begin() + 5 * static_cast<std::ptrdiff_t>(b),
                  y.begin() + 5 * static_cast<std::ptrdiff_t>(b + 1));
  const SobolIndices without = sobol_indices(rest, std::vector<std::uint8_t>(rest.size(), 0), 3);
  EXPECT_EQ(found.inputs[0].first.value, without.inputs[0].first.value);
  EXPECT_EQ(found.inputs[2].total.ci95.lower, without.inputs[2].total.ci95.lower);
}

TEST(SobolIndices, NestedSizesAreBeginningsOfTheWhole) {
  const SaltelliPoints small(SamplingDesign::sobol, 1, 3, 128), large(SamplingDesign::sobol, 1, 3, 512);
  const std::vector<double> y = evaluate(large, ishigami);
  const auto nested = nested_sobol_indices(y, std::vector<std::uint8_t>(y.size(), 0), 3, 64);
  ASSERT_EQ(nested.size(), 4U);
  EXPECT_EQ(nested[0].blocks, 64U);
  EXPECT_EQ(nested[3].blocks, 512U);
  EXPECT_EQ(nested[1].inputs[1].total.value, indices_of(small, ishigami).inputs[1].total.value);
  EXPECT_LT(nested[3].inputs[1].total.ci95.half_width(), nested[0].inputs[1].total.ci95.half_width());
}

TEST(SobolIndices, TooFewWholeBlocksAreRefused) {
  const std::vector<double> y(50, 1.0);
  std::vector<std::uint8_t> status(50, 0);
  for (std::size_t k = 0; k < 40; k += 5)
    status[k] = 1;
  EXPECT_THROW(sobol_indices(y, status, 3), std::invalid_argument);
}

void cover(const Function& f, const Known& known, int inputs, int trials, double tolerance) {
  const std::size_t n = known.first.size();
  Coverage coverage(2 * n);
  for (int t = 0; t < trials; ++t) {
    const SobolIndices found = indices_of(
        SaltelliPoints(SamplingDesign::random, static_cast<std::uint64_t>(t) + 1, inputs, 1024), f);
    for (std::size_t i = 0; i < n; ++i) {
      coverage.add(i, found.inputs[i].first, known.first[i]);
      coverage.add(n + i, found.inputs[i].total, known.total[i]);
    }
  }
  coverage.expect(trials, tolerance);
}

TEST(SobolCoverage, IntervalsOfIshigami) {
  cover(ishigami, ishigami_indices(), 3, 60, coverage_tolerance(60));
}
TEST(SobolCoverageNightly, IntervalsOfIshigami) {
  cover(ishigami, ishigami_indices(), 3, 1000, 0.02);
}
TEST(SobolCoverageNightly, IntervalsOfTheGFunction) {
  cover(g_function, g_indices(), 5, 1000, 0.02);
}

} // namespace
} // namespace strainwave
