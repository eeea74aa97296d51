#pragma once
// The two-disc elastica as a shooting problem, solved with SUNDIALS: CVODES (Adams) integrates the free arc,
// KINSOL (Newton) finds the lift-off arc a, the curvature's slope h = N/EI and, when the wrap angle is given
// instead, the eccentricity e. R = r_m + u0 - e.
//
//     free arc      x' = cos psi,  y' = sin psi,  psi' = 1/R + h (y - y_L)     (kappa' = h sin psi,
//     integrated) at lift-off   x = e + R cos a,  y = y_L = R sin a,  psi = pi/2 + a;  arc length R a minor
//     axis    x = 0,  psi = pi;  arc length pi r_m/2
// Integration starts at the lift-off because the slope of the curvature jumps there.

#include "strainwave/common/core/outcome.hpp"

namespace strainwave {

struct ElasticaProblem {
  double neutral_radius_mm = 0.0;
  double u0_mm = 0.0;
  /// Which of the two numbers is given: eccentricity [mm], or the polar angle of lift-off [rad].
  bool eccentricity_given = true;
  double given = 0.0;
};

struct LiftOff {
  double arc_rad = 0.0;           ///< a, angle about the disc's centre
  double n_over_ei_per_mm2 = 0.0; ///< h
  double eccentricity_mm = 0.0;
};

/// From a start (the first-order solution is a good one) to the solution, errors about 100 times the relative
/// tolerance.
Outcome<LiftOff> shoot(const ElasticaProblem&, const LiftOff& start, double relative_tolerance = 1e-10);

} // namespace strainwave
