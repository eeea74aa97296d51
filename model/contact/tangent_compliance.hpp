#pragma once
// The teeth as they yield about a loaded state: the wall contact that given tooth forces bring about is held,
// and the answer to tooth forces is then linear,
//
//     gap = q − θ r + D F,     D = M_tt − M_tA M_AA⁻¹ M_At,     q = q_t − M_tA M_AA⁻¹ q_A,
//
// with t the points of the teeth and A the closed wall stations. Exact for all forces that keep A closed and
// the rest open; bounds (optimize/gear/force_bound.hpp) and rough estimates use it. Wall gaps are those of
// the LoadProblem (about the assembled state). Without wall stations in the problem (fidelity linear) M_tt
// already holds the wall, and nothing changes.

#include "strainwave/model/contact/load_problem.hpp"

namespace strainwave {

struct TangentCompliance {
  Eigen::MatrixXd d;        ///< mm/N, points × points, along the forces; symmetric positive definite
  Eigen::VectorXd gap_mm;   ///< q, along the forces
  Eigen::VectorXd lever_mm; ///< r; torque of a force about the axis
  ActiveSet wall;           ///< A; empty for fidelity linear
};

/// force_n: of the points, ≥ 0. Throws NotPositiveDefinite.
TangentCompliance tangent_compliance(const LoadProblem& load, const Eigen::VectorXd& force_n,
                                     ContactSolver& solver);

} // namespace strainwave
