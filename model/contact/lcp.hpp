#pragma once
// Unilateral contact as a linear complementarity problem with one parameter, the rotation θ of the circular spline:
//
//     gap(θ) = q − θ r + M z ≥ 0,    z ≥ 0,    z · gap = 0,    M symmetric positive definite
//
// One solution z(θ) for every θ, piecewise linear; r · z (torque per lobe, with r = contact radii) never falls.
// Unknowns z [N] are tooth forces (r_i = contact radius, mm) and, with unilateral wall contact, wall forces (r_i = 0);
// gaps q [mm], M [mm/N]. See physics: Cottle, Pang, Stone, The Linear Complementarity Problem (1992), chapters 3 and 4.
//
// M is not an M-matrix in general, so a plain primal–dual active set can cycle: solve_at() detects a repeated set and
// falls back to a finite pivoting method.

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

namespace strainwave {

struct ContactProblem {
  Eigen::MatrixXd m; ///< mm/N, n × n
  Eigen::VectorXd q; ///< mm, n
  Eigen::VectorXd r; ///< mm, n, ≥ 0
};

using ActiveSet = std::vector<std::uint8_t>; ///< 1: closed

struct ContactState {
  double rotation = 0.0;      ///< θ, rad
  Eigen::VectorXd force;      ///< z, N
  Eigen::VectorXd gap;        ///< mm
  ActiveSet active;
  double torque = 0.0;        ///< r · z, N·mm
  double stiffness = 0.0;     ///< d torque / dθ on this active set (towards larger θ), N·mm/rad
  int iterations = 0;         ///< active sets tried
  bool fallback = false;      ///< the finite method was needed
};

/// Residuals that prove a state, each relative to the scale given.
struct ContactCertificate {
  double complementarity = 0.0; ///< max |z gap| / (max |z| max |q − θ r|)
  double min_gap = 0.0;         ///< mm (negative: penetration)
  double min_force = 0.0;       ///< N (negative: tension)
};

} // namespace strainwave
