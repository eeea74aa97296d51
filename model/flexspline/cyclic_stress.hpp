#pragma once
// Stress of every element of the ring from the displacements of its nodes (cyclic_field.hpp).

#include "strainwave/model/flexspline/mesh.hpp"

#include <Eigen/Core>

namespace strainwave {

/// Largest von Mises stress of every element of the ring, MPa: rows sector·(elements of a sector) + element.
/// Stresses are taken at the 2 × 2 × 2 integration points, where they are most accurate, and carried on to
/// the corners trilinearly, so that bending of a wall one element thick shows its surface value.
Eigen::MatrixXd largest_von_mises(const SectorMesh& mesh, const Material& material,
                                  const Eigen::MatrixXd& displacement);

} // namespace strainwave
