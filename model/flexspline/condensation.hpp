#pragma once
// Static condensation of a sector onto its two boundaries.
//
// Whatever does not lie on the boundary planes is the same real problem for every harmonic, so it is
// eliminated once. With i the inside, b = (left, right) the boundaries and c the loads,
//
//        S = K_bb − K_bi K_ii⁻¹ K_ib     c̄ = c_b − K_bi K_ii⁻¹ c_i     W = c_iᵀ K_ii⁻¹ c_i
//
// The free sector (bore fixed) is positive definite, so one sparse Cholesky factorization of all of it with
// the boundary ordered last gives everything: its last block L_bb has S = L_bb L_bbᵀ, and the forward solve
// y = L⁻¹ P c has W = y_iᵀ y_i and c̄ = L_bb y_b.
//
// Rounding. A free cup tilts on its thin diaphragm and ovalises: large displacements with hardly any strain,
// so rounding errors of the size ε |K| are multiplied by |K| |u|²/energy, 10⁷ and more. energy() takes that
// back where it matters: for approximate displacements u under loads f the value 2 fᵀu − uᵀK u is wrong only
// by the square of u's error; it is found as fᵀu + uᵀr with the residual r = f − K u in twice the working
// precision.

#include "strainwave/model/flexspline/functionals.hpp"
#include "strainwave/model/flexspline/mesh.hpp"

#include <memory>
#include <vector>

#include <Eigen/Core>

namespace strainwave {

class CondensedSector {
public:
  /// Throws NotPositiveStiffness when the sector is not positive definite, std::bad_alloc without memory.
  CondensedSector(const SectorMesh& mesh, const Material& material,
                  const std::vector<const SectorWeights*>& weights);
  ~CondensedSector();
  CondensedSector(const CondensedSector&) = delete;
  CondensedSector& operator=(const CondensedSector&) = delete;

  /// 2 FᵀU − UᵀK U for loads F on all unknowns (as `loads`) and displacements U of both boundaries (as
  /// `stiffness`), the inside following from them; symmetric.
  Eigen::MatrixXd energy(const Eigen::MatrixXd& force, const Eigen::MatrixXd& at_boundary) const;

  /// Displacements of all unknowns from loads on them and displacements of both boundaries.
  Eigen::MatrixXd displacement(const Eigen::MatrixXd& force, const Eigen::MatrixXd& at_boundary) const;

  /// Of each degree of freedom 3·node + component: −1 fixed, else its unknown: inside, left, right.
  std::vector<int> unknown;
  /// Boundary degrees of freedom of sector 0 that are not fixed, as places 3·(index into mesh.left) +
  /// component.
  std::vector<int> boundary;
  Eigen::MatrixXd stiffness; ///< S: left boundary first, then right, each in the order of `boundary`
  Eigen::MatrixXd load;      ///< c̄, one column a load
  Eigen::MatrixXd inside;    ///< W, symmetric
  Eigen::MatrixXd loads;     ///< c on all unknowns: inside, left, right

private:
  struct Content;
  std::unique_ptr<Content> content;
};

} // namespace strainwave
