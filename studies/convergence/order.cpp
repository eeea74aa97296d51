#include "strainwave/studies/convergence/order.hpp"

#include <algorithm>
#include <cmath>

namespace strainwave {

std::optional<ObservedOrder> observed_order(std::span<const double> size, std::span<const double> value) {
  if (size.size() < 3 || value.size() != size.size())
    return std::nullopt;
  const auto h = size.last(3), f = value.last(3);
  const double coarse = f[0] - f[1], fine = f[1] - f[2];
  const double rounding = 1e-13 * std::max({std::abs(f[0]), std::abs(f[1]), std::abs(f[2])});
  if (!(h[0] > h[1] && h[1] > h[2] && h[2] > 0.0) || !(std::abs(fine) > rounding))
    return std::nullopt;
  const double wanted = coarse / fine;
  const auto ratio = [&](double p) { // rises with p
    const double third = std::pow(h[0] / h[2], p), second = std::pow(h[1] / h[2], p);
    return (third - second) / (second - 1.0);
  };
  double lower = 1e-3, upper = 20.0;
  if (!(ratio(lower) < wanted && wanted < ratio(upper)))
    return std::nullopt;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (lower + upper);
    (ratio(middle) < wanted ? lower : upper) = middle;
  }
  const double p = 0.5 * (lower + upper);
  return ObservedOrder{p, f[2] - fine / (std::pow(h[1] / h[2], p) - 1.0)};
}

} // namespace strainwave
