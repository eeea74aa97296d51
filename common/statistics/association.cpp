#include "strainwave/common/statistics/association.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace strainwave {

namespace {

constexpr double no_correlation = 2.0;

/// More than rounding in the mean leaves behind?
bool varies(double square_sum, double mean, double n) {
  const double rounding = 2.3e-16 * n * mean;
  return square_sum > n * rounding * rounding;
}

double correlation_of(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size() || x.size() < 4)
    throw std::invalid_argument("a correlation needs at least 4 pairs");
  const double n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    yy += (y[i] - my) * (y[i] - my);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return varies(xx, mx, n) && varies(yy, my, n) ? std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0)
                                                : no_correlation;
}

Estimate with_interval(double r, double spread) {
  if (r == no_correlation)
    return {0.0, {-1.0, 1.0}};
  if (std::abs(r) == 1.0)
    return {r, {r, r}};
  const double z = std::atanh(r), half = normal_975 * spread;
  return {r, {std::tanh(z - half), std::tanh(z + half)}};
}

} // namespace

Estimate pearson_correlation(std::span<const double> x, std::span<const double> y) {
  const double r = correlation_of(x, y);
  return with_interval(r, 1.0 / std::sqrt(static_cast<double>(x.size()) - 3.0));
}

Estimate spearman_of_ranks(std::span<const double> x_ranks, std::span<const double> y_ranks) {
  const double r = correlation_of(x_ranks, y_ranks);
  return with_interval(r, std::sqrt((1.0 + 0.5 * r * r) / (static_cast<double>(x_ranks.size()) - 3.0)));
}

std::vector<double> ranks_of(std::span<const double> values) {
  std::vector<std::pair<double, std::size_t>> order(
      values.size()); // values beside their places: a million sort in the cache
  for (std::size_t i = 0; i < values.size(); ++i)
    order[i] = {values[i], i};
  std::ranges::sort(order, {}, [](const auto& one) { return one.first; });
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() && order[end].first == order[i].first)
      ++end;
    const double shared = 0.5 * static_cast<double>(i + 1 + end); // mean of i + 1 … end
    for (; i < end; ++i)
      ranks[order[i].second] = shared;
  }
  return ranks;
}

double elasticity(double derivative, double input, double output) {
  return derivative * input / output;
}

} // namespace strainwave
