#pragma once
// What may vary: numbers of the gear by their path, each between two bounds, and numbers that move along.
//
// A search never sees millimetres beside micrometres. It works in scaled coordinates
//
//     y = (x − lower) / scale,        0 ≤ y ≤ (upper − lower) / scale,
//
// where scale is a typical change of the number; without one it is the whole range, so that y runs from 0
// to 1. A linked number follows its variable as  number = ratio · x  (an eccentricity in proportion to u0).

#include "strainwave/model/gear/fields.hpp"

#include <span>
#include <vector>

namespace strainwave {

struct LinkedNumber {
  NumberPath path;
  double ratio = 1.0;
};

struct DesignVariable {
  NumberPath path;
  double lower = 0.0; ///< in the unit of the key, like upper and start
  double upper = 0.0;
  double start = 0.0;
  double scale = 0.0; ///< typical change; 0: upper − lower
  std::vector<LinkedNumber> links = {};
};

class DesignSpace {
public:
  /// Throws FieldError where bounds cross, a start lies outside them, or a scale is negative.
  explicit DesignSpace(std::vector<DesignVariable> variables);

  std::size_t size() const { return variables_.size(); }
  std::span<const DesignVariable> variables() const { return variables_; }

  std::vector<double> start() const;
  std::vector<double> scaled(std::span<const double> x) const;
  /// The bounds are met exactly, whatever the rounding of y.
  std::vector<double> unscaled(std::span<const double> y) const;
  /// Upper bounds of y; the lower ones are 0.
  std::vector<double> scaled_upper() const;

  /// `base` with the numbers of this design. Throws FieldError where a number leaves the range of its key.
  Gear apply(const Gear& base, std::span<const double> x) const;
  /// The numbers that `gear` has.
  std::vector<double> read(const Gear& gear) const;

private:
  std::vector<DesignVariable> variables_;
};

} // namespace strainwave
