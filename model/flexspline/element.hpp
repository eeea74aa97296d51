#pragma once
// The 20-node serendipity hexahedron with reduced integration, the same element as CalculiX's C3D20R.
//
// Shape functions on ξ, η, ζ ∈ [−1, 1] (Zienkiewicz & Taylor, The Finite Element Method, vol. 1, serendipity
// family):
//   corner    N = (1 + ξξ_a)(1 + ηη_a)(1 + ζζ_a)(ξξ_a + ηη_a + ζζ_a − 2)/8
//   mid-side  N = (1 − ξ²)(1 + ηη_a)(1 + ζζ_a)/4   where ξ_a = 0, likewise for the other directions
// Nodes 1 … 8 are the corners (ζ = −1 first, counter-clockwise seen from +ζ), 9 … 12 the mid-sides of ζ = −1,
// 13 … 16 those of ζ = +1, 17 … 20 those along ζ. Integration at the 2 × 2 × 2 Gauss points, which removes
// locking of thin walls and leaves a lone element six zero-energy patterns. A row of boxes held at one end
// keeps some, two rows side by side none: a tooth needs two elements along the face, and a ring of one
// element in its section must be held all over it (tests/model/flexspline/zero_energy_test.cpp).

#include "strainwave/model/gear/gear.hpp"

#include <array>

#include <Eigen/Core>

namespace strainwave {

struct SectorMesh;

using ElementPoints = Eigen::Matrix<double, 20, 3>;     ///< Cartesian coordinates of the nodes, mm
using ElementStiffness = Eigen::Matrix<double, 60, 60>; ///< row 3·node + component, N/mm

Eigen::Matrix<double, 20, 1> hexahedron_shape(const Eigen::Vector3d& local);
/// Derivatives by ξ, η, ζ, one node a row.
Eigen::Matrix<double, 20, 3> hexahedron_shape_gradient(const Eigen::Vector3d& local);

/// Local coordinates of the eight integration points (weights 1), ξ fastest.
std::array<Eigen::Vector3d, 8> hexahedron_integration_points();

/// Isotropic linear elasticity, Cartesian components.
ElementStiffness hexahedron_stiffness(const ElementPoints& points, const Material& material);

/// Smallest determinant of ∂x/∂ξ at the integration points and the corners; positive in a sound element.
double smallest_jacobian(const ElementPoints& points);

/// Nodes of an element of sector 0.
ElementPoints element_points(const SectorMesh& mesh, int element);

/// The same stiffness with every node's components in the cylindrical frame (e_r, e_φ, e_z) of its own angle.
ElementStiffness cylindrical_stiffness(const SectorMesh& mesh, int element, const Material& material);

} // namespace strainwave
