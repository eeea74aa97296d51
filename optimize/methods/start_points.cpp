#include "strainwave/optimize/methods/start_points.hpp"

#include "strainwave/common/sampling/counter_random.hpp"

#include <cmath>

namespace strainwave {

namespace {

/// The root of g^(d+1) = g + 1 above 1.
double generalised_golden_ratio(std::size_t d) {
  double g = 1.5;
  for (int i = 0; i < 60; ++i)
    g = std::pow(1.0 + g, 1.0 / static_cast<double>(d + 1));
  return g;
}

} // namespace

std::vector<std::vector<double>> start_points(const DesignSpace& design, std::size_t count,
                                              std::uint64_t seed) {
  std::vector<std::vector<double>> points;
  if (count == 0)
    return points;
  points.push_back(design.scaled(design.start()));
  const std::vector<double> upper = design.scaled_upper();
  std::vector<double> shift(upper.size());
  random_uniforms({seed, RandomPurpose::search_starts}, 0, shift);
  const double g = generalised_golden_ratio(upper.size());
  for (std::size_t k = 1; k < count; ++k) {
    std::vector<double> y;
    for (std::size_t i = 0; i < upper.size(); ++i) {
      const double step = std::pow(g, -static_cast<double>(i + 1));
      const double turns = shift[i] + static_cast<double>(k) * step;
      y.push_back((turns - std::floor(turns)) * upper[i]);
    }
    points.push_back(std::move(y));
  }
  return points;
}

} // namespace strainwave
