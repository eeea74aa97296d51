#pragma once
// Derivatives of a contact state by one adjoint back-substitution for each functional.
//
// On a strict closed set A (no index with force and gap both zero) the state is smooth: z_A = M_AA⁻¹ (θ r_A −
// q_A). For
//     J = w · z + g · gap + ω θ        (w, g: weights by index; ω: weight of the rotation)
// let λ = M_AA⁻¹ (w + M g)_A, s = M_AA⁻¹ r_A. Held rotation: μ = 0. Held torque (θ follows): μ = (λ·r + ω −
// g·r) / (s·r_A), which is dJ/dT. With η = λ − μ s and ζ = g − η (η = 0 outside A):
//     dJ/dq_i = ζ_i,     dJ/dr_i = −θ ζ_i − μ z_i,     dJ/dM_ij = ζ_i z_j,     dJ/dθ = λ·r + ω − g·r   or
//     dJ/dT = μ.
// dJ/dM_ij counts (i, j) and (j, i) as two entries; a symmetric change moves both.
//
// Worked number: one index, M = 1e-4, q = 4e-3, r = 14.5, θ = 1e-3: J = z has dJ/dq = −1/M = −1e4 N/mm, dJ/dr
// = θ/M = 10.
//
// Where an index is biactive the state has a kink: the values are those of the closed set as it stands, one
// of the one-sided derivatives at most, and `biactive` names the indices.

#include "strainwave/model/lcp/solver.hpp"

#include <vector>

namespace strainwave {

struct ContactDerivative {
  Eigen::VectorXd gap;    ///< dJ/dq = ζ, J per mm
  Eigen::VectorXd radius; ///< dJ/dr, J per mm
  double control = 0.0;   ///< dJ/dθ (held rotation), J per rad, or dJ/dT (held torque), J per N·mm
  Eigen::VectorXd force;  ///< z, N
  std::vector<int> biactive;
  /// dJ/dM_ij, J per mm/N.
  double matrix(int i, int j) const { return gap[i] * force[j]; }
};

/// Weights of a functional J = w · z + g · gap + ω θ; an empty vector counts as zeros.
struct ContactFunctional {
  Eigen::VectorXd force; ///< w, n
  Eigen::VectorXd gap;   ///< g, n
  double rotation = 0.0; ///< ω
};

/// One factorization of a state, any number of functionals. The problem must outlive it.
class ContactSensitivity {
public:
  enum class Held { rotation, torque };
  /// Throws std::invalid_argument for Held::torque on a state without a loaded index (r > 0).
  ContactSensitivity(const ContactProblem& problem, const ContactState& state, Held held);
  ContactDerivative of(const ContactFunctional& functional) const;

private:
  const ContactProblem& problem_;
  Held held_;
  double rotation_, stiffness_ = 0.0; ///< rad; s · r on the closed set
  Eigen::VectorXd force_, s_;         ///< N; N/rad (0 outside the closed set)
  std::vector<int> biactive_;
  ActiveFactor factor_;
};

} // namespace strainwave
