#include "strainwave/common/statistics/morris.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace strainwave {

namespace {

double spread_of(std::span<const double> x, double mean) {
  double square = 0.0;
  for (double v : x)
    square += (v - mean) * (v - mean);
  return std::sqrt(square / (static_cast<double>(x.size()) - 1.0));
}

Estimate mean_of(std::span<const double> x) {
  const double n = static_cast<double>(x.size());
  double mean = 0.0;
  for (double v : x)
    mean += v / n;
  const double half = student_975(n - 1.0) * spread_of(x, mean) / std::sqrt(n);
  return {mean, {mean - half, mean + half}};
}

} // namespace

MorrisResult morris_effects(const MorrisPoints& points, std::span<const double> values,
                            std::span<const std::uint8_t> status) {
  const std::size_t inputs = points.inputs(), rows = inputs + 1;
  if (values.size() != points.rows() || status.size() != points.rows())
    throw std::logic_error("morris_effects: other rows than the design's");
  MorrisResult result;
  std::vector<std::vector<double>> effects(inputs);
  for (std::uint64_t t = 0; t < points.rows() / rows; ++t) {
    if (!std::ranges::all_of(status.subspan(t * rows, rows), [](std::uint8_t s) { return s == 0; })) {
      ++result.dropped_trajectories;
      continue;
    }
    ++result.trajectories;
    const auto steps = points.steps(t);
    for (std::size_t s = 0; s < inputs; ++s)
      effects[steps[s].input].push_back((values[t * rows + s + 1] - values[t * rows + s]) / steps[s].change);
  }
  if (result.trajectories < 2)
    throw std::invalid_argument("fewer than two trajectories without a failed row: no Morris effects");
  for (std::vector<double>& effect : effects) {
    MorrisEffect e;
    e.mu = mean_of(effect);
    e.sigma = spread_of(effect, e.mu.value);
    for (double& x : effect)
      x = std::abs(x);
    e.mu_star = mean_of(effect);
    result.inputs.push_back(e);
  }
  return result;
}

} // namespace strainwave
