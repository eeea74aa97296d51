#pragma once
// The ring, or an open part of it, sector by sector: node numbers, and the plain full solution.
//
// The full solution is the slow and simple reference of the cyclic one, serves bodies that are no ring
// (beams, quarter rings) in tests, and gives the displacements of a whole cup under any loads.

#include "strainwave/model/flexspline/functionals.hpp"
#include "strainwave/model/flexspline/mesh.hpp"
#include "strainwave/model/flexspline/sparse.hpp"

#include <memory>
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

/// One sparse factorization of the whole part; solutions are refined twice with residuals in twice the
/// working precision (a free cup multiplies rounding by 10⁷, see condensation.hpp).
class RingSolver {
public:
  /// `also_fixed`: further supports, 3·node + component. Throws as SparseCholesky does.
  RingSolver(const RingPart& part, const Material& material, const std::vector<int>& also_fixed = {});
  /// Displacements under forces, both 3·nodes() in cylindrical frames, a column each.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& force) const;

private:
  std::vector<int> unknown;
  SparseAssembly assembly{0};
  std::unique_ptr<SparseCholesky> factor;
};

} // namespace strainwave
