#pragma once
// Displacements of every node of the ring under any loads, from one sector.
//
// The sector's inside is eliminated once (Z = K_ii⁻¹ (K_il K_ir)); what remains are the boundary planes u_j,
// one for each sector, coupled to their neighbours alone:
//
//        A u_j + C u_{j+1} + Cᵀ u_{j−1} = r_j      A = S_ll + S_rr,  C = S_lr
//        r_j = f_j − Z_lᵀ f_i,j − Z_rᵀ f_i,{j−1}   (f_j: on plane j, f_i,j: inside sector j)
//
// a block-circulant system. A discrete Fourier transform over the sectors makes it a small Hermitian positive
// definite one for each harmonic (cyclic.hpp), and the inside follows sector by sector,
//
//        u_i,j = K_ii⁻¹ f_i,j − Z_l u_j − Z_r u_{j+1}.
//
// Unlike the factor of the whole ring (the tests' reference) this needs the memory of one sector.

#include "strainwave/model/flexspline/functionals.hpp"
#include "strainwave/model/flexspline/mesh.hpp"

#include <vector>

#include <Eigen/Core>

namespace strainwave {

/// `factor` (N, or N·mm for rotations) times a functional of one sector.
struct FieldLoad {
  const Functional* functional = nullptr;
  int sector = 0;
  double factor = 0.0;
};

struct RingField {
  /// 3·ring_node + {radial, circumferential, axial} in the frame of the node's own angle, mm; a column for
  /// each case.
  Eigen::MatrixXd displacement;
  /// Nodal forces of the loads, same rows and columns, N.
  Eigen::MatrixXd force;
  /// Largest |K u − f| at free degrees of freedom over the largest |f|, all cases.
  double residual = 0.0;
};

/// Throws std::logic_error when a matrix is not positive definite, std::bad_alloc without memory.
RingField ring_field(const SectorMesh& mesh, const Material& material,
                     const std::vector<std::vector<FieldLoad>>& cases);

/// Displacements of one element of sector `sector` from those of the ring, in the element's order: 3·node +
/// component.
Eigen::Matrix<double, 60, 1> element_displacement(const SectorMesh& mesh, std::size_t element, int sector,
                                                  const Eigen::Ref<const Eigen::VectorXd>& displacement);

} // namespace strainwave
