#pragma once
// Sector mesh: one tooth pitch of the cup in 20-node hexahedra; copies turned by 2π/sectors make the ring.
//
//        r                        tooth (only in the middle of the pitch)
//        │                  ┌────────────┐ tip_radius
//        │       wall       │    face    │ front
//        ├─┬────────────────┴────────────┴─┐ root_radius
//        │ ├───────────────────────────────┘ neutral_radius − rim_thickness/2 (inner wall, one surface)
//        │ │ diaphragm
//        │ │ z = 0 in its middle                          z = cup_length at the open end
//        └─┘ boss_radius, the bore is fixed
//
// The mesh is a meridian section of 8-node quadrilaterals swept over the pitch: every node has a meridian
// lattice place (i along the radius of diaphragm, wall and tooth; j along the axis) and an angular place k,
// in half elements. The sector's boundaries k = 0 and k = 2·per_pitch lie in the middle of the tooth gaps at
// ∓π/sectors, the tooth centre at 0. A tooth narrows with the radius as its involute flanks do
// (tooth_outline.hpp); rim, wall and diaphragm keep the angles of the tooth's feet. The sector is its own
// mirror image in φ → −φ, which the cyclic solver uses. Where wall and rim differ in thickness, one extra row
// of elements behind the face makes the step at 45°.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/gear/gear.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace strainwave {

struct CartesianPoint {
  double x = 0.0, y = 0.0, z = 0.0; ///< mm
};

/// Cylindrical coordinates: radius_mm, angle_rad from the tooth centre of sector 0, z_mm.
struct CylinderPoint {
  double radius = 0.0, angle = 0.0, z = 0.0;
};

/// One side of an element, numbered 1 … 6 as CalculiX numbers the faces of a C3D20R.
struct ElementFace {
  int element = 0;
  int side = 0;
};

enum class Region { diaphragm, corner, wall, rim, tooth, front };

struct SectorMesh {
  int sectors = 0;
  std::vector<CylinderPoint> nodes; ///< of sector 0, both boundaries included
  std::vector<std::array<int, 20>>
      elements;               ///< node indices in the C3D20R order; local ξ radial, η along φ, ζ along z
  std::vector<Region> region; ///< of each element
  std::vector<int> left, right; ///< boundary nodes at −π/sectors and their images at +π/sectors
  std::vector<int> fixed;       ///< degrees of freedom 3·node + {0 radial, 1 circumferential, 2 axial}
  std::vector<int> boss;        ///< nodes of the bore (all their degrees of freedom are fixed)
  std::vector<ElementFace> drive_flank; ///< tooth flank at larger φ (side 5)
  std::vector<ElementFace> coast_flank; ///< its mirror image at smaller φ (side 3)
  std::vector<ElementFace> inner_wall;  ///< inner surface of wall, rim and front (side 6)
  std::vector<int> ring_index; ///< place of a node among those its sector owns; −1 on the right boundary
  std::vector<int> left_twin;  ///< node of the left boundary that a right node coincides with; else −1

  double pitch_rad() const;
  /// Nodes of one sector in the ring, the right boundary belonging to the next sector.
  int owned() const { return static_cast<int>(nodes.size() - right.size()); }
  std::size_t ring_nodes() const {
    return static_cast<std::size_t>(owned()) * static_cast<std::size_t>(sectors);
  }
  std::size_t ring_elements() const { return elements.size() * static_cast<std::size_t>(sectors); }
  /// Number of node i of a sector in the closed ring, 0-based.
  int ring_node(int i, int sector) const;
  double angle(int i, int sector) const;
  /// Cartesian coordinates of node i of a sector.
  CartesianPoint node(int i, int sector) const;

  /// Fills ring_index, left_twin from nodes, left, right; every builder of a SectorMesh ends with it.
  void number();
};

struct SectorShape {
  bool teeth = true;
  int sectors = 0; ///< 0: as many as teeth. Any number for the smooth cup
};

/// The mesh, or the sentence that says why these numbers make none.
Outcome<SectorMesh> sector_mesh(const Flexspline& flexspline, const Mesh& counts,
                                const SectorShape& shape = {});

/// Elements of a sector, and unknowns on one of its sides, by the counts alone: never less than what
/// sector_mesh() makes.
struct MeshSize {
  double elements = 0.0, side_unknowns = 0.0;
};
MeshSize mesh_size(const Flexspline& flexspline, const Mesh& counts, bool teeth);

/// About half the counts of every direction, at least what a mesh needs: for estimates of the discretisation
/// error.
Mesh coarser(const Mesh& counts, bool teeth);

} // namespace strainwave
