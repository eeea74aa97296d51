#pragma once
// Is every derivative right? Each entry (response × variable, and the pieces) is compared with differences of
// the evaluator at ever smaller steps. The error of a central difference falls as h² towards a right
// derivative, until rounding takes over; a wrong one leaves an error that stays. At a bound the one-sided
// formula of the same order stands in,
//
//     central  [f(h) − f(−h)] / 2h            one-sided  [4 f(h) − 3 f(0) − f(2h)] / 2h
//
// Steps are shares of the variable's range, from 2⁻⁷ down to 2⁻¹⁹ by factors of 2. An entry is
//   right    its error falls with order 2 (factor 3.2 … 4.8 twice running) and ends below 10⁻³, or comes
//   below 10⁻⁵, of the
//            derivative's size, or within what rounding leaves (noise / step)
//   kink     the two one-sided slopes stay apart, and the derivative is one of them or lies between: no
//   single number is right wrong    neither unknown  the evaluator states none (NaN), or its neighbours fail
// The size of a derivative: the larger of itself and of a 10⁻⁶ part of the response over the variable's
// range.

#include "strainwave/optimize/problem/design.hpp"
#include "strainwave/optimize/problem/evaluator.hpp"

#include <array>
#include <string>
#include <vector>

namespace strainwave {

enum class SlopeVerdict { wrong, unknown, kink, right };

struct SlopeCheck {
  std::string response; ///< its name; "piece 17 of peak_force_n" for the worst of the pieces
  std::size_t variable = 0;
  double value = 0.0;
  double exact = 0.0;
  double difference = 0.0;       ///< the one that came nearest
  std::array<double, 3> error{}; ///< relative to the size, at the three steps of the table
  std::array<double, 3> step{};  ///< of the variable, in its unit
  double left = 0.0,
         right =
             0.0; ///< one-sided slopes at the smallest step that rounding leaves meaning; equal but at kinks
  double least_error = 0.0; ///< relative, of all steps
  SlopeVerdict verdict = SlopeVerdict::right;
};

struct GradientCheck {
  bool ok = false;
  std::string message;            ///< why there is nothing to check
  std::vector<SlopeCheck> slopes; ///< worst first
  std::size_t wrong = 0;
};

struct GradientCheckOptions {
  double noise = 1e-12; ///< rounding of a value, relative to it
};

/// At x; asks `evaluator` for its gradients there and for some 26 evaluations for each variable.
GradientCheck check_gradient(Evaluator& evaluator, const DesignSpace& design, std::span<const double> x,
                             const GradientCheckOptions& options = {});

} // namespace strainwave
