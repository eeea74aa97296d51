#pragma once
// Static condensation of a sector onto its two boundaries.
//
// Whatever does not lie on the boundary planes is the same real problem for every harmonic, so it is
// eliminated once. With i the inside, b = (left, right) the boundaries and c the loads,
//
//        S = K_bb − K_bi K_ii⁻¹ K_ib     c̄ = c_b − K_bi K_ii⁻¹ c_i     W = c_iᵀ K_ii⁻¹ c_i
//
// The free sector (bore fixed) is positive definite, so one sparse Cholesky factorization of all of it with
// the boundary ordered last gives everything: its last block L_bb has S = L_bb L_bbᵀ, and the forward solve y
// = L⁻¹ P c has W = y_iᵀ y_i and c̄ = L_bb y_b.

#include "model/flexspline/functionals.hpp"
#include "model/flexspline/mesh.hpp"

#include <vector>

#include <Eigen/Core>

namespace strainwave {

struct CondensedSector {
  /// Boundary degrees of freedom of sector 0 that are not fixed, as places 3·(index into mesh.left) +
  /// component.
  std::vector<int> boundary;
  Eigen::MatrixXd stiffness; ///< S: left boundary first, then right, each in the order of `boundary`
  Eigen::MatrixXd load;      ///< c̄, one column a load
  Eigen::MatrixXd inside;    ///< W, symmetric
};

/// Throws NotPositiveStiffness when the sector is not positive definite, std::bad_alloc without memory.
CondensedSector condense(const SectorMesh& mesh, const Material& material,
                         const std::vector<const SectorWeights*>& loads);

} // namespace strainwave
