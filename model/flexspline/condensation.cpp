#include "strainwave/model/flexspline/condensation.hpp"

#include "strainwave/model/flexspline/blas.hpp"
#include "strainwave/model/flexspline/element.hpp"
#include "strainwave/model/flexspline/sparse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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

struct CondensedSector::Content {
  SparseAssembly assembly;
  std::unique_ptr<SparseCholesky> factor;
  int inside;
};

CondensedSector::CondensedSector(const SectorMesh& mesh, const Material& material,
                                 const std::vector<const SectorWeights*>& weights) {
  const SectorNumbering numbering = number_unknowns(mesh);
  content = std::make_unique<Content>(Content{SparseAssembly(numbering.total), nullptr, numbering.inside});
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ElementStiffness element = cylindrical_stiffness(mesh, static_cast<int>(e), material);
    std::array<int, 60> place{};
    for (std::size_t a = 0; a < 60; ++a)
      place[a] = numbering.unknown[3 * static_cast<std::size_t>(mesh.elements[e][a / 3]) + a % 3];
    content->assembly.add(place, element);
  }
  content->factor = std::make_unique<SparseCholesky>(content->assembly, numbering.inside);
  const SparseCholesky& factor = *content->factor;

  const int total = numbering.total, first = numbering.inside, size = total - first;
  const auto columns = static_cast<Eigen::Index>(weights.size());
  loads = Eigen::MatrixXd::Zero(total, columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    const SectorWeights& each = *weights[static_cast<std::size_t>(c)];
    for (std::size_t n = 0; n < each.dof.size(); ++n) {
      const int row = numbering.unknown[static_cast<std::size_t>(each.dof[n])];
      if (row >= 0)
        loads(row, c) += each.weight[n];
    }
  }
  const Eigen::MatrixXd y = factor.forward(loads);

  boundary = numbering.boundary;
  unknown = numbering.unknown;
  Eigen::MatrixXd last = factor.last_block(first); // lower triangle, factor order
  inside = y.topRows(first).transpose() * y.topRows(first);
  const Eigen::MatrixXd last_load = last.triangularView<Eigen::Lower>() * y.bottomRows(size);

  // S = L Lᵀ in the factor's order, then back to left, right.
  Eigen::MatrixXd squared(size, size);
  const double one = 1.0, zero = 0.0;
  dsyrk_("L", "N", &size, &size, &one, last.data(), &size, &zero, squared.data(), &size);
  stiffness.resize(size, size);
  load.resize(size, columns);
  const std::vector<int> order = factor.order();
  for (int c = 0; c < size; ++c) {
    const int to_c = order[static_cast<std::size_t>(first + c)] - first;
    load.row(to_c) = last_load.row(c);
    for (int r = c; r < size; ++r) {
      const int to_r = order[static_cast<std::size_t>(first + r)] - first;
      stiffness(to_r, to_c) = stiffness(to_c, to_r) = squared(r, c);
    }
  }
}

CondensedSector::~CondensedSector() = default;

Eigen::MatrixXd CondensedSector::displacement(const Eigen::MatrixXd& force,
                                              const Eigen::MatrixXd& at_boundary) const {
  const Eigen::Index first = content->inside, size = at_boundary.rows();
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(first + size, force.cols());
  u.bottomRows(size) = at_boundary;
  u.topRows(first) = content->factor->solve_inside(residual(content->assembly, force, u).topRows(first));
  return u;
}

Eigen::MatrixXd CondensedSector::energy(const Eigen::MatrixXd& force,
                                        const Eigen::MatrixXd& at_boundary) const {
  const Eigen::MatrixXd u = displacement(force, at_boundary);
  const Eigen::MatrixXd twice = force.transpose() * u + u.transpose() * residual(content->assembly, force, u);
  return 0.5 * (twice + twice.transpose());
}

} // namespace strainwave
