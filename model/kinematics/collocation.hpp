#pragma once
// The free arc of the two-disc elastica at Chebyshev points. With t in [-1, 1] along the arc of half-length
// l, psi at n points satisfies the integrated equation
//     psi(t) = pi/2 + a + (l/R)(t + 1) + l^2 h int int sin psi
//     psi(1) = pi,   e + R cos a + l int cos psi = 0
//     e = given  or  polar lift-off angle = given
// n + 3 equations for psi, a, h and e (notation of shooting.hpp). Integrated instead of differentiated
// because the integration matrix keeps rounding at 1e-16 where differentiation would lift it to n^4 1e-16.
// Newton from the shooting's solution takes two or three steps; the last factorization gives the derivatives
// with respect to r_m, u0 and the given number (implicit differentiation).
// Source of the method: L. Greengard, SIAM J. Numer. Anal. 28 (1991) 1071, spectral integration.

#include "strainwave/model/kinematics/chebyshev.hpp"
#include "strainwave/model/kinematics/shooting.hpp"

#include <Eigen/Core>

#include <optional>

namespace strainwave {

struct FreeArcSolution {
  const ChebyshevGrid* grid = nullptr;
  Eigen::VectorXd psi; ///< at the grid's nodes
  LiftOff lift_off;
  Eigen::Matrix<double, Eigen::Dynamic, 3> psi_by; ///< by r_m, u0, given number; at fixed t
  Eigen::Matrix<double, 2, 3> lift_off_by;         ///< rows a, e
};

/// Nothing when Newton does not converge or psi is not resolved.
std::optional<FreeArcSolution> collocate(const ElasticaProblem&, const LiftOff& start);

} // namespace strainwave
