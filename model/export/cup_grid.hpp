#pragma once
// The whole ring's mesh as VTK sees it: quadratic hexahedra (cell type 25).
//
// VTK's quadratic hexahedron numbers its corners 0 … 3 (ζ = −1), 4 … 7 (ζ = +1), then the mid-sides of the
// bottom (8 … 11), of the top (12 … 15) and of the upright edges (16 … 19, from corner 0 to 4 first): the
// order of the C3D20R. (Other formats differ here: Gmsh, and Abaqus' own printed order of CalculiX's .frd.)

#include "strainwave/model/export/vtkhdf.hpp"
#include "strainwave/model/flexspline/mesh.hpp"

#include <Eigen/Core>

namespace strainwave {

inline constexpr std::uint8_t vtk_quadratic_hexahedron = 25;

/// Points and cells, with point data `tooth` (the tooth on whose pitch the node lies, −z1/2 < tooth ≤ z1/2)
/// and cell data `tooth`, `region` (Region's values), `sector`.
UnstructuredGrid ring_grid(const SectorMesh& mesh);

/// Vectors of all nodes of the ring, in the cylindrical frame of each node's own angle, as Cartesian x, y, z.
std::vector<double> cartesian(const SectorMesh& mesh, const Eigen::Ref<const Eigen::VectorXd>& cylindrical);

} // namespace strainwave
