#include "strainwave/optimize/problem/design.hpp"

#include <algorithm>
#include <cmath>

namespace strainwave {

DesignSpace::DesignSpace(std::vector<DesignVariable> variables) : variables_(std::move(variables)) {
  for (DesignVariable& v : variables_) {
    const std::string path = v.path.path();
    if (!(v.lower < v.upper) || !std::isfinite(v.upper - v.lower))
      throw FieldError(path, "the lower bound " + shortest(v.lower) + " has to be below the upper bound " +
                                 shortest(v.upper));
    if (!(v.start >= v.lower && v.start <= v.upper))
      throw FieldError(path, "the start " + shortest(v.start) + " lies outside the bounds " +
                                 shortest(v.lower) + " … " + shortest(v.upper));
    if (!(v.scale >= 0.0) || !std::isfinite(v.scale))
      throw FieldError(path, "the scale has to be above 0");
    if (v.scale == 0.0)
      v.scale = v.upper - v.lower;
  }
}

std::vector<double> DesignSpace::start() const {
  std::vector<double> x;
  for (const DesignVariable& v : variables_)
    x.push_back(v.start);
  return x;
}

std::vector<double> DesignSpace::scaled(std::span<const double> x) const {
  std::vector<double> y(size());
  for (std::size_t i = 0; i < size(); ++i)
    y[i] = (x[i] - variables_[i].lower) / variables_[i].scale;
  return y;
}

std::vector<double> DesignSpace::unscaled(std::span<const double> y) const {
  std::vector<double> x(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const DesignVariable& v = variables_[i];
    const bool at_upper = y[i] >= (v.upper - v.lower) / v.scale;
    x[i] = at_upper ? v.upper : std::clamp(v.lower + y[i] * v.scale, v.lower, v.upper);
  }
  return x;
}

std::vector<double> DesignSpace::scaled_upper() const {
  std::vector<double> y;
  for (const DesignVariable& v : variables_)
    y.push_back((v.upper - v.lower) / v.scale);
  return y;
}

Gear DesignSpace::apply(const Gear& base, std::span<const double> x) const {
  Gear gear = base;
  for (std::size_t i = 0; i < size(); ++i) {
    variables_[i].path.set(gear, x[i]);
    for (const LinkedNumber& link : variables_[i].links)
      link.path.set(gear, link.ratio * x[i]);
  }
  return gear;
}

std::vector<double> DesignSpace::read(const Gear& gear) const {
  std::vector<double> x;
  for (const DesignVariable& v : variables_)
    x.push_back(v.path.get(gear));
  return x;
}

} // namespace strainwave
