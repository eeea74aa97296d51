#include "strainwave/common/sampling/distribution.hpp"
#include "strainwave/common/sampling/normal_quantile.hpp"

#include <cmath>
#include <numbers>

namespace strainwave {

namespace {

struct Moments {
  double mean, std;
};

double normal_density(double z) {
  return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}

Moments moments(const Normal& d) {
  return {d.mean, d.std};
}
Moments moments(const Lognormal& d) {
  return {d.mean, d.std};
}
Moments moments(const Uniform& d) {
  return {0.5 * (d.lower + d.upper), (d.upper - d.lower) / std::sqrt(12.0)};
}
Moments moments(const Triangular& d) {
  const double a = d.lower, b = d.upper, c = d.mode;
  return {(a + b + c) / 3.0, std::sqrt((a * a + b * b + c * c - a * b - a * c - b * c) / 18.0)};
}
/// Johnson, Kotz, Balakrishnan, "Continuous univariate distributions" 1 (1994), section 13.10.
Moments moments(const TruncatedNormal& d) {
  const double a = (d.lower - d.mean) / d.std, b = (d.upper - d.mean) / d.std;
  const double kept = normal_cdf(b) - normal_cdf(a);
  const double shift = (normal_density(a) - normal_density(b)) / kept;
  const double variance = 1.0 + (a * normal_density(a) - b * normal_density(b)) / kept - shift * shift;
  return {d.mean + d.std * shift, d.std * std::sqrt(variance)};
}
/// Uniform pieces.
Moments moments(const Tabulated& d) {
  double mean = 0.0, square = 0.0;
  for (std::size_t i = 1; i < d.value.size(); ++i) {
    const double share = d.cumulative[i] - d.cumulative[i - 1];
    const double a = d.value[i - 1], b = d.value[i];
    mean += share * 0.5 * (a + b);
    square += share * (a * a + a * b + b * b) / 3.0;
  }
  return {mean, std::sqrt(std::max(square - mean * mean, 0.0))};
}

} // namespace

double mean_of(const Distribution& distribution) {
  return std::visit([](const auto& d) { return moments(d).mean; }, distribution);
}

double std_of(const Distribution& distribution) {
  return std::visit([](const auto& d) { return moments(d).std; }, distribution);
}

} // namespace strainwave
