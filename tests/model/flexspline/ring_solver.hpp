#pragma once
// The plain full solution of a ring, or of an open part of it: the slow and simple reference of the cyclic
// one, and for bodies that are no ring (beams, quarter rings).

#include "strainwave/model/flexspline/element.hpp"
#include "strainwave/model/flexspline/ring.hpp"
#include "strainwave/model/flexspline/sparse.hpp"
#include "strainwave/model/gear/gear.hpp"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace strainwave::testing_support {

/// One sparse factorization of the whole part; solutions are refined twice with residuals in twice the
/// working precision (a free cup multiplies rounding by 10⁷, see condensation.hpp).
class RingSolver {
public:
  /// `also_fixed`: further supports, 3·node + component. Throws as SparseCholesky does.
  RingSolver(const RingPart& part, const Material& material, const std::vector<int>& also_fixed = {}) {
    unknown.assign(3 * static_cast<std::size_t>(part.nodes()), 0);
    for (const int dof : part.fixed())
      unknown[static_cast<std::size_t>(dof)] = -1;
    for (const int dof : also_fixed)
      unknown[static_cast<std::size_t>(dof)] = -1;
    int size = 0;
    for (int& u : unknown)
      if (u == 0)
        u = size++;
    assembly = SparseAssembly(size);
    const SectorMesh& mesh = part.mesh();
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const ElementStiffness stiffness = cylindrical_stiffness(mesh, static_cast<int>(e), material);
      for (int j = 0; j < part.sectors(); ++j) {
        std::array<int, 60> place{};
        for (std::size_t a = 0; a < 60; ++a)
          place[a] = unknown[3 * static_cast<std::size_t>(part.node(mesh.elements[e][a / 3], j)) + a % 3];
        assembly.add(place, stiffness);
      }
    }
    factor = std::make_unique<SparseCholesky>(assembly);
  }

  /// Displacements under forces, both 3·nodes() in cylindrical frames, a column each.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& force) const {
    Eigen::MatrixXd inner(assembly.size(), force.cols());
    for (std::size_t dof = 0; dof < unknown.size(); ++dof)
      if (unknown[dof] >= 0)
        inner.row(unknown[dof]) = force.row(static_cast<Eigen::Index>(dof));
    Eigen::MatrixXd solution = factor->solve(inner);
    for (int step = 0; step < 2; ++step)
      solution += factor->solve(residual(assembly, inner, solution));
    Eigen::MatrixXd displacement = Eigen::MatrixXd::Zero(force.rows(), force.cols());
    for (std::size_t dof = 0; dof < unknown.size(); ++dof)
      if (unknown[dof] >= 0)
        displacement.row(static_cast<Eigen::Index>(dof)) = solution.row(unknown[dof]);
    return displacement;
  }

private:
  std::vector<int> unknown;
  SparseAssembly assembly{0};
  std::unique_ptr<SparseCholesky> factor;
};

} // namespace strainwave::testing_support
