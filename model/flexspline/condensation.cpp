#include "model/flexspline/condensation.hpp"

#include "model/flexspline/blas.hpp"
#include "model/flexspline/element.hpp"
#include "model/flexspline/sparse.hpp"

#include <algorithm>
#include <stdexcept>

namespace strainwave {

namespace {

/// Unknowns of the sector: −1 fixed, else a number. The boundary's come last: left, then right.
struct SectorNumbering {
  std::vector<int> unknown;
  std::vector<int> boundary;
  int inside = 0, total = 0;
};

SectorNumbering number_unknowns(const SectorMesh& mesh) {
  SectorNumbering numbering;
  constexpr int free = -2, on_boundary = -3;
  numbering.unknown.assign(3 * mesh.nodes.size(), free);
  for (const auto* side : {&mesh.left, &mesh.right})
    for (const int node : *side)
      for (int c = 0; c < 3; ++c)
        numbering.unknown[static_cast<std::size_t>(3 * node + c)] = on_boundary;
  for (const int dof : mesh.fixed)
    numbering.unknown[static_cast<std::size_t>(dof)] = -1;
  for (int& unknown : numbering.unknown)
    if (unknown == free)
      unknown = numbering.inside++;
  numbering.total = numbering.inside;
  for (std::size_t b = 0; b < mesh.left.size(); ++b)
    for (int c = 0; c < 3; ++c)
      if (numbering.unknown[static_cast<std::size_t>(3 * mesh.left[b] + c)] == on_boundary)
        numbering.boundary.push_back(static_cast<int>(3 * b) + c);
  for (const auto* side : {&mesh.left, &mesh.right})
    for (const int place : numbering.boundary) {
      int& unknown = numbering.unknown[static_cast<std::size_t>(
          3 * (*side)[static_cast<std::size_t>(place / 3)] + place % 3)];
      if (unknown != on_boundary)
        throw std::logic_error("a boundary node is fixed on one side of the sector only");
      unknown = numbering.total++;
    }
  return numbering;
}

} // namespace

CondensedSector condense(const SectorMesh& mesh, const Material& material,
                         const std::vector<const SectorWeights*>& loads) {
  const SectorNumbering numbering = number_unknowns(mesh);
  SparseAssembly assembly(numbering.total);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ElementStiffness stiffness = cylindrical_stiffness(mesh, static_cast<int>(e), material);
    std::array<int, 60> unknown{};
    for (std::size_t a = 0; a < 60; ++a)
      unknown[a] = numbering.unknown[static_cast<std::size_t>(3 * mesh.elements[e][a / 3]) + a % 3];
    assembly.add(unknown, stiffness);
  }
  const SparseCholesky factor(assembly, numbering.inside);

  const int total = numbering.total, inside = numbering.inside, boundary = total - inside;
  const auto columns = static_cast<Eigen::Index>(loads.size());
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(total, columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    const SectorWeights& weights = *loads[static_cast<std::size_t>(c)];
    for (std::size_t n = 0; n < weights.dof.size(); ++n) {
      const int unknown = numbering.unknown[static_cast<std::size_t>(weights.dof[n])];
      if (unknown >= 0)
        y(unknown, c) += weights.weight[n];
    }
  }
  y = factor.forward(y);

  CondensedSector condensed;
  condensed.boundary = numbering.boundary;
  Eigen::MatrixXd last = factor.last_block(inside); // lower triangle, factor order
  const Eigen::MatrixXd y_inside = y.topRows(inside);
  condensed.inside = y_inside.transpose() * y_inside;
  Eigen::MatrixXd load = last.triangularView<Eigen::Lower>() * y.bottomRows(boundary);

  // S = L Lᵀ in the factor's order, then back to left, right.
  Eigen::MatrixXd product(boundary, boundary);
  const double one = 1.0, zero = 0.0;
  last.triangularView<Eigen::StrictlyUpper>().setZero();
  dsyrk_("L", "N", &boundary, &boundary, &one, last.data(), &boundary, &zero, product.data(), &boundary);
  condensed.stiffness.resize(boundary, boundary);
  condensed.load.resize(boundary, columns);
  const std::vector<int> order = factor.order();
  for (int c = 0; c < boundary; ++c) {
    const int to_c = order[static_cast<std::size_t>(inside + c)] - inside;
    condensed.load.row(to_c) = load.row(c);
    for (int r = c; r < boundary; ++r) {
      const int to_r = order[static_cast<std::size_t>(inside + r)] - inside;
      condensed.stiffness(to_r, to_c) = condensed.stiffness(to_c, to_r) = product(r, c);
    }
  }
  return condensed;
}

} // namespace strainwave
