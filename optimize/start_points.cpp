#include "optimize/start_points.hpp"

#include <cmath>

namespace strainwave {

namespace {

/// A well mixed number in [0, 1) for a counter (SplitMix64, G. Steele et al., OOPSLA 2014).
double mixed(std::uint64_t counter) {
  std::uint64_t z = counter + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1.0p-53;
}

/// The root of g^(d+1) = g + 1 above 1.
double generalised_golden_ratio(std::size_t d) {
  double g = 1.5;
  for (int i = 0; i < 60; ++i)
    g = std::pow(1.0 + g, 1.0 / static_cast<double>(d + 1));
  return g;
}

} // namespace

std::vector<std::vector<double>> start_points(const Design& design, std::size_t count, std::uint64_t seed) {
  std::vector<std::vector<double>> points;
  if (count == 0)
    return points;
  points.push_back(design.scaled(design.start()));
  const std::vector<double> upper = design.scaled_upper();
  const double g = generalised_golden_ratio(upper.size());
  for (std::size_t k = 1; k < count; ++k) {
    std::vector<double> y;
    for (std::size_t i = 0; i < upper.size(); ++i) {
      const double step = std::pow(g, -static_cast<double>(i + 1));
      const double turns = mixed(seed * 1000003u + i) + static_cast<double>(k) * step;
      y.push_back((turns - std::floor(turns)) * upper[i]);
    }
    points.push_back(std::move(y));
  }
  return points;
}

} // namespace strainwave
