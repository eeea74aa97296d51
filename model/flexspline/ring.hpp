#pragma once
// The ring, or an open part of it, sector by sector: node numbers, loads and measurements.

#include "strainwave/model/flexspline/functionals.hpp"
#include "strainwave/model/flexspline/mesh.hpp"

#include <vector>

#include <Eigen/Core>

namespace strainwave {

/// Numbers the nodes of `sectors` neighbouring sectors; all of them: the closed ring.
class RingPart {
public:
  /// sectors 0: the whole ring. The mesh must outlive this.
  explicit RingPart(const SectorMesh& sector_mesh, int sectors = 0);

  const SectorMesh& mesh() const { return sector; }
  int sectors() const { return count; }
  bool closed() const { return count == sector.sectors; }
  int nodes() const;
  int elements() const { return count * static_cast<int>(sector.elements.size()); }
  /// 0-based number of node i of sector j, 0 ≤ j < sectors().
  int node(int i, int j) const;
  /// Cartesian coordinates and angles of all nodes in the order of their numbers.
  std::vector<CartesianPoint> points() const;
  std::vector<double> angles() const;
  /// Supports: 3·node + component in cylindrical frames, ascending.
  std::vector<int> fixed() const;
  /// Adds factor × a functional of sector j to forces in cylindrical frames, 3·nodes() of them.
  void add_load(const Functional& functional, int j, double factor, Eigen::Ref<Eigen::VectorXd> force) const;
  /// The functional's mean displacement.
  double measure(const Functional& functional, int j,
                 const Eigen::Ref<const Eigen::VectorXd>& displacement) const;

private:
  const SectorMesh& sector;
  int count;
  std::vector<int> left_place; ///< of a right node: its pair's place among the left nodes
};

} // namespace strainwave
