#include "strainwave/common/statistics/morris.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <stdexcept>

namespace strainwave {
namespace {

std::vector<double> evaluate(const MorrisPoints& points, auto&& f) {
  std::vector<double> u(points.rows() * points.inputs()), y;
  points.points(0, points.rows(), u);
  for (std::uint64_t k = 0; k < points.rows(); ++k)
    y.push_back(f(std::span(u).subspan(k * points.inputs(), points.inputs())));
  return y;
}

TEST(MorrisPoints, EveryStepMovesOneInputByHalfTheRangeAndStaysInside) {
  const MorrisPoints points(3, 6, 20);
  std::vector<double> u(points.rows() * 6);
  points.points(0, points.rows(), u);
  for (double x : u)
    EXPECT_TRUE(x == 0.125 || x == 0.375 || x == 0.625 || x == 0.875) << x;
  for (std::uint64_t t = 0; t < 20; ++t) {
    std::set<std::size_t> moved;
    const auto steps = points.steps(t);
    for (std::size_t s = 0; s < 6; ++s) {
      moved.insert(steps[s].input);
      for (std::size_t i = 0; i < 6; ++i) {
        const double change = u[(t * 7 + s + 1) * 6 + i] - u[(t * 7 + s) * 6 + i];
        EXPECT_EQ(change, i == steps[s].input ? steps[s].change : 0.0);
      }
    }
    EXPECT_EQ(moved.size(), 6U);
  }
}

// A linear function has its slopes as effects, without spread; a product has an effect that hangs on the
// other input.
TEST(Morris, LinearEffectsAreExactAndInteractionsShowAsSpread) {
  const MorrisPoints points(1, 4, 50);
  const auto y =
      evaluate(points, [](std::span<const double> u) { return 3.0 * u[0] - 2.0 * u[1] + 8.0 * u[2] * u[3]; });
  const MorrisResult result = morris_effects(points, y, std::vector<std::uint8_t>(y.size(), 0));
  EXPECT_NEAR(result.inputs[0].mu.value, 3.0, 1e-13);
  EXPECT_NEAR(result.inputs[0].sigma, 0.0, 1e-13);
  EXPECT_NEAR(result.inputs[1].mu.value, -2.0, 1e-13);
  EXPECT_NEAR(result.inputs[1].mu_star.value, 2.0, 1e-13);
  // u is one of 1/8, 3/8, 5/8, 7/8: mean ½, spread √5/8; so mu = 4, sigma = √5.
  EXPECT_TRUE(result.inputs[2].mu.ci95.contains(4.0));
  EXPECT_NEAR(result.inputs[2].sigma, std::sqrt(5.0), 0.5);
}

TEST(Morris, ATrajectoryWithAFailedRowIsDropped) {
  const MorrisPoints points(1, 2, 10);
  auto y = evaluate(points, [](std::span<const double> u) { return u[0] + u[1]; });
  std::vector<std::uint8_t> status(y.size(), 0);
  status[4] = 1;
  y[4] = 1e300;
  const MorrisResult result = morris_effects(points, y, status);
  EXPECT_EQ(result.trajectories, 9U);
  EXPECT_EQ(result.dropped_trajectories, 1U);
  EXPECT_NEAR(result.inputs[1].mu.value, 1.0, 1e-13);
}

} // namespace
} // namespace strainwave
