#pragma once
// First derivatives of the scaled objective and limits, in scaled coordinates. Exact where the evaluator
// knows its gradient; else by differences,
//
//     ∂f/∂y_i ≈ [f(y + h e_i) − f(y − h e_i)] / 2h,      h = 1e-5 of the coordinate's range,
//
// one-sided at a bound or where a neighbour fails. Values of the forward model carry rounding of about 1e-12,
// so the difference is good to about 1e-7; at a kink it is a mean of the two sides.

#include "strainwave/optimize/problem/problem.hpp"

#include <functional>
#include <span>
#include <vector>

namespace strainwave {

struct Slopes {
  bool ok = false;
  std::vector<double> objective;  ///< by coordinate
  std::vector<double> constraint; ///< limit by limit, coordinates inside: [k · n + i]
};

inline constexpr double difference_step = 1e-5;

/// `ask` gives the points that differences need.
Slopes slopes_at(const Problem& problem, const SearchPoint& at,
                 const std::function<SearchPoint(std::span<const double>)>& ask);

} // namespace strainwave
