#include "strainwave/model/flexspline/cyclic_field.hpp"

#include "strainwave/model/flexspline/blas.hpp"
#include "strainwave/model/flexspline/element.hpp"
#include "strainwave/model/flexspline/sparse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace strainwave {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Where a degree of freedom of the sector stands: inside (0 …), on the left plane, on the right plane; −1
/// fixed.
struct SectorOrder {
  std::vector<int> place;
  std::vector<int> inside_row, plane_row; ///< rows 3·ring_index + component within a sector's owned block
  int inside = 0, plane = 0;

  explicit SectorOrder(const SectorMesh& mesh) : place(3 * mesh.nodes.size(), 0) {
    std::vector<int> kind(mesh.nodes.size(), 0); // 0 inside, 1 left, 2 right
    for (const int node : mesh.left)
      kind[static_cast<std::size_t>(node)] = 1;
    for (const int node : mesh.right)
      kind[static_cast<std::size_t>(node)] = 2;
    for (const int dof : mesh.fixed)
      place[static_cast<std::size_t>(dof)] = -1;
    for (std::size_t dof = 0; dof < place.size(); ++dof) {
      if (place[dof] < 0 || kind[dof / 3] == 2)
        continue;
      const int row = 3 * mesh.ring_index[dof / 3] + static_cast<int>(dof % 3);
      if (kind[dof / 3] == 0) {
        place[dof] = inside++;
        inside_row.push_back(row);
      } else {
        place[dof] = plane++;
        plane_row.push_back(row);
      }
    }
    const auto each = [&](int wanted, const auto& visit) {
      for (std::size_t dof = 0; dof < place.size(); ++dof)
        if (place[dof] >= 0 && kind[dof / 3] == wanted)
          visit(dof);
    };
    each(1, [&](std::size_t dof) { place[dof] += inside; });
    each(2, [&](std::size_t dof) {
      const int left = place[3 * static_cast<std::size_t>(mesh.left_twin[dof / 3]) + dof % 3];
      place[dof] = left < 0 ? -1 : left + plane;
    });
  }
};

std::array<int, 60> element_dofs(const SectorMesh& mesh, std::size_t element) {
  std::array<int, 60> dofs{};
  for (std::size_t a = 0; a < 60; ++a)
    dofs[a] = 3 * mesh.elements[element][a / 3] + static_cast<int>(a % 3);
  return dofs;
}

/// The planes' system after elimination of the inside.
class CyclicPlanes {
public:
  CyclicPlanes(const SectorMesh& mesh, const SectorOrder& sector_order,
               const std::vector<ElementStiffness>& stiffness)
      : order(sector_order), sectors(mesh.sectors) {
    SparseAssembly inner(order.inside);
    MatrixXd coupling = MatrixXd::Zero(order.inside, 2 * order.plane);
    MatrixXd planes = MatrixXd::Zero(2 * order.plane, 2 * order.plane);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      std::array<int, 60> place = element_dofs(mesh, e), inside{};
      for (std::size_t a = 0; a < 60; ++a) {
        place[a] = order.place[static_cast<std::size_t>(place[a])];
        inside[a] = place[a] < order.inside ? place[a] : -1;
      }
      inner.add(inside, stiffness[e]);
      for (std::size_t b = 0; b < 60; ++b) {
        if (place[b] < order.inside)
          continue;
        for (std::size_t a = 0; a < 60; ++a) {
          const double value = stiffness[e](static_cast<Index>(a), static_cast<Index>(b));
          if (place[a] >= order.inside)
            planes(place[a] - order.inside, place[b] - order.inside) += value;
          else if (place[a] >= 0)
            coupling(place[a], place[b] - order.inside) += value;
        }
      }
    }
    factor = std::make_unique<SparseCholesky>(inner);
    z = factor->solve(coupling);
    planes.noalias() -= coupling.transpose() * z;
    const Index n = order.plane;
    own = planes.topLeftCorner(n, n) + planes.bottomRightCorner(n, n);
    across = planes.topRightCorner(n, n);
  }

  /// Displacements from nodal forces, rows 3·ring_index + component; a block of a column for each sector and
  /// each case.
  MatrixXd solve(const MatrixXd& force) const {
    const Index n = order.plane, columns = force.cols();
    const MatrixXd inside = force(order.inside_row, Eigen::all);
    const MatrixXd right = z.rightCols(n).transpose() * inside;
    MatrixXd load = force(order.plane_row, Eigen::all);
    load.noalias() -= z.leftCols(n).transpose() * inside;
    for (Index j = 0; j < columns; ++j)
      load.col(next_sector(j)) -= right.col(j);
    const MatrixXd plane = solve_planes(load);
    MatrixXd ahead(n, columns);
    for (Index j = 0; j < columns; ++j)
      ahead.col(j) = plane.col(next_sector(j));
    MatrixXd here = factor->solve(inside);
    here.noalias() -= z.leftCols(n) * plane;
    here.noalias() -= z.rightCols(n) * ahead;
    MatrixXd displacement = MatrixXd::Zero(force.rows(), columns);
    displacement(order.plane_row, Eigen::all) = plane;
    displacement(order.inside_row, Eigen::all) = here;
    return displacement;
  }

private:
  /// Column of the same case's next sector.
  Index next_sector(Index column) const {
    return column % sectors == sectors - 1 ? column - sectors + 1 : column + 1;
  }

  MatrixXd solve_planes(const MatrixXd& load) const {
    const Index harmonics = sectors / 2 + 1, cases = load.cols() / sectors;
    MatrixXd plane = MatrixXd::Zero(order.plane, load.cols());
    for (Index h = 0; h < harmonics; ++h) {
      Eigen::VectorXcd wave(sectors); // e^{i h j 2π/N}
      for (Index j = 0; j < sectors; ++j)
        wave(j) = std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>((h * j) % sectors) /
                                      static_cast<double>(sectors));
      const std::complex<double> turn = wave(1 % sectors);
      const MatrixXcd stiffness =
          own.cast<std::complex<double>>() + turn * across + std::conj(turn) * across.transpose();
      const Eigen::LLT<MatrixXcd> harmonic(stiffness);
      if (harmonic.info() != Eigen::Success)
        throw std::logic_error("a harmonic of the ring is not positive definite");
      MatrixXcd amplitude(order.plane, cases);
      for (Index c = 0; c < cases; ++c)
        amplitude.col(c) = load.middleCols(c * sectors, sectors) * wave.conjugate();
      harmonic.solveInPlace(amplitude);
      const double share = (h == 0 || 2 * h == sectors ? 1.0 : 2.0) / static_cast<double>(sectors);
      for (Index c = 0; c < cases; ++c)
        plane.middleCols(c * sectors, sectors).noalias() +=
            share * (amplitude.col(c).real() * wave.real().transpose() -
                     amplitude.col(c).imag() * wave.imag().transpose());
    }
    return plane;
  }

  const SectorOrder& order;
  Index sectors;
  std::unique_ptr<SparseCholesky> factor; ///< of K_ii
  MatrixXd z, own, across;
};

double residual_of(const SectorMesh& mesh, const std::vector<ElementStiffness>& stiffness,
                   const RingField& field) {
  MatrixXd rest = -field.force;
  Eigen::Matrix<double, 60, Eigen::Dynamic> local(60, rest.cols()), nodal(60, rest.cols());
  for (int j = 0; j < mesh.sectors; ++j)
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      for (Index c = 0; c < rest.cols(); ++c)
        local.col(c) = element_displacement(mesh, e, j, field.displacement.col(c));
      nodal.noalias() = stiffness[e] * local;
      for (std::size_t a = 0; a < 20; ++a)
        rest.middleRows<3>(3 * static_cast<Index>(mesh.ring_node(mesh.elements[e][a], j))) +=
            nodal.middleRows<3>(3 * static_cast<Index>(a));
    }
  for (int j = 0; j < mesh.sectors; ++j)
    for (const int dof : mesh.fixed)
      rest.row(3 * mesh.ring_node(dof / 3, j) + dof % 3).setZero();
  double worst = 0.0;
  for (Index c = 0; c < rest.cols(); ++c)
    if (const double scale = field.force.col(c).cwiseAbs().maxCoeff(); scale > 0.0)
      worst = std::max(worst, rest.col(c).cwiseAbs().maxCoeff() / scale);
  return worst;
}

} // namespace

Eigen::Matrix<double, 60, 1> element_displacement(const SectorMesh& mesh, std::size_t element, int sector,
                                                  const Eigen::Ref<const VectorXd>& displacement) {
  Eigen::Matrix<double, 60, 1> values;
  for (std::size_t a = 0; a < 20; ++a)
    values.segment<3>(3 * static_cast<Index>(a)) =
        displacement.segment<3>(3 * static_cast<Index>(mesh.ring_node(mesh.elements[element][a], sector)));
  return values;
}

RingField ring_field(const SectorMesh& mesh, const Material& material,
                     const std::vector<std::vector<FieldLoad>>& cases) {
  openblas_set_num_threads(1);
  const SectorOrder order(mesh);
  std::vector<ElementStiffness> stiffness(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    stiffness[e] = cylindrical_stiffness(mesh, static_cast<int>(e), material);
  const CyclicPlanes planes(mesh, order, stiffness);

  const auto rows = 3 * static_cast<Index>(mesh.ring_nodes());
  RingField field;
  field.force = MatrixXd::Zero(rows, static_cast<Index>(cases.size()));
  for (std::size_t c = 0; c < cases.size(); ++c) {
    auto force = field.force.col(static_cast<Index>(c));
    const auto add = [&](const SectorWeights& weights, int sector, double factor) {
      for (std::size_t n = 0; n < weights.dof.size(); ++n)
        force[3 * mesh.ring_node(weights.dof[n] / 3, sector) + weights.dof[n] % 3] +=
            factor * weights.weight[n];
    };
    for (const FieldLoad& load : cases[c]) {
      add(load.functional->here, load.sector, load.factor);
      add(load.functional->next, (load.sector + 1) % mesh.sectors, load.factor);
    }
  }
  // Rows 3·ring_node + component of a case are, sector by sector, the columns of its block.
  const Eigen::Map<const MatrixXd> by_sector(field.force.data(), 3 * mesh.owned(),
                                             static_cast<Index>(mesh.sectors) * field.force.cols());
  field.displacement = planes.solve(by_sector).reshaped(rows, field.force.cols());
  field.residual = residual_of(mesh, stiffness, field);
  return field;
}

} // namespace strainwave
