#include "strainwave/model/flexspline/element.hpp"

#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace strainwave {
namespace {

const Material steel{.youngs_modulus_mpa = 206000.0, .poisson_ratio = 0.3};

/// Corner signs of the first eight nodes and the ends of the edges that carry the others.
constexpr int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                              {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
constexpr int edge[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                             {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

/// An assembly of hexahedra on a lattice whose corners a function places; edges are straight.
struct Patch {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 20>> elements;
  std::vector<std::array<int, 3>> lattice; ///< in half elements

  template <class Place>
  Patch(std::array<int, 3> counts, const Place& place) {
    std::map<std::array<int, 3>, int> index_of;
    for (int i = 0; i < counts[0]; ++i)
      for (int j = 0; j < counts[1]; ++j)
        for (int k = 0; k < counts[2]; ++k) {
          std::array<int, 20> nodes{};
          for (std::size_t a = 0; a < 20; ++a) {
            const int* first = corner[a < 8 ? static_cast<int>(a) : edge[a - 8][0]];
            const int* second = corner[a < 8 ? static_cast<int>(a) : edge[a - 8][1]];
            const std::array<int, 3> at = {2 * i + first[0] + second[0], 2 * j + first[1] + second[1],
                                           2 * k + first[2] + second[2]};
            const auto [entry, is_new] = index_of.try_emplace(at, static_cast<int>(points.size()));
            nodes[a] = entry->second;
            if (!is_new)
              continue;
            lattice.push_back(at);
            points.push_back(0.5 * (place(i + first[0], j + first[1], k + first[2]) +
                                    place(i + second[0], j + second[1], k + second[2])));
          }
          elements.push_back(nodes);
        }
  }

  Eigen::MatrixXd stiffness() const {
    const auto size = static_cast<Eigen::Index>(3 * points.size());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
    for (const auto& nodes : elements) {
      ElementPoints x;
      for (int a = 0; a < 20; ++a)
        x.row(a) = points[static_cast<std::size_t>(nodes[static_cast<std::size_t>(a)])];
      const ElementStiffness ke = hexahedron_stiffness(x, steel);
      for (int a = 0; a < 20; ++a)
        for (int b = 0; b < 20; ++b)
          k.block<3, 3>(3 * nodes[static_cast<std::size_t>(a)], 3 * nodes[static_cast<std::size_t>(b)]) +=
              ke.block<3, 3>(3 * a, 3 * b);
    }
    return k;
  }
};

/// Solves K u = f where `known` entries of u are given.
Eigen::VectorXd solve(const Eigen::MatrixXd& k, const Eigen::VectorXd& f,
                      const std::map<int, double>& known) {
  std::vector<Eigen::Index> open;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(k.rows());
  for (Eigen::Index n = 0; n < k.rows(); ++n) {
    const auto at = known.find(static_cast<int>(n));
    if (at == known.end())
      open.push_back(n);
    else
      u[n] = at->second;
  }
  const Eigen::VectorXd rest = f - k * u;
  const auto size = static_cast<Eigen::Index>(open.size());
  Eigen::MatrixXd inner(size, size);
  Eigen::VectorXd force(size);
  for (Eigen::Index c = 0; c < size; ++c) {
    const Eigen::Index from = open[static_cast<std::size_t>(c)];
    force[c] = rest[from];
    for (Eigen::Index r = 0; r < size; ++r)
      inner(r, c) = k(open[static_cast<std::size_t>(r)], from);
  }
  const Eigen::VectorXd part = inner.ldlt().solve(force);
  for (Eigen::Index c = 0; c < size; ++c)
    u[open[static_cast<std::size_t>(c)]] = part[c];
  return u;
}

Patch distorted_patch() {
  // Inner corners of a 2 × 2 × 2 patch moved by up to a quarter of an element: no two elements are alike.
  return Patch({2, 2, 2}, [](int i, int j, int k) {
    Eigen::Vector3d x(i, 1.3 * j, 0.7 * k);
    if (i == 1)
      x += Eigen::Vector3d(0.17, -0.11 * j, 0.06 * k);
    if (j == 1)
      x += Eigen::Vector3d(-0.08 * k, 0.21, 0.05 * i);
    if (k == 1)
      x += Eigen::Vector3d(0.07 * j, 0.09 * i, -0.12);
    return x;
  });
}

TEST(Element, shape_functions_are_one_at_their_node_and_sum_to_one) {
  for (int a = 0; a < 20; ++a) {
    Eigen::Vector3d local;
    for (int d = 0; d < 3; ++d)
      local[d] = a < 8 ? 2 * corner[a][d] - 1 : corner[edge[a - 8][0]][d] + corner[edge[a - 8][1]][d] - 1;
    const Eigen::Matrix<double, 20, 1> shape = hexahedron_shape(local);
    for (int b = 0; b < 20; ++b)
      EXPECT_NEAR(shape[b], a == b ? 1.0 : 0.0, 1e-15);
  }
  const Eigen::Vector3d inside(0.3, -0.7, 0.1);
  EXPECT_NEAR(hexahedron_shape(inside).sum(), 1.0, 1e-15);
  EXPECT_LT(hexahedron_shape_gradient(inside).colwise().sum().norm(), 1e-14);
}

TEST(Element, shape_gradient_is_the_derivative) {
  const Eigen::Vector3d at(0.21, -0.43, 0.67);
  const double step = 1e-5; // central difference of cubics: error of the order step² = 1e-10
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d shift = step * Eigen::Vector3d::Unit(d);
    const auto slope = ((hexahedron_shape(at + shift) - hexahedron_shape(at - shift)) / (2.0 * step)).eval();
    EXPECT_LT((slope - hexahedron_shape_gradient(at).col(d)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Element, rigid_motions_give_no_force) {
  const Patch patch = distorted_patch();
  const Eigen::MatrixXd k = patch.stiffness();
  for (int mode = 0; mode < 6; ++mode) {
    Eigen::VectorXd u(k.rows());
    for (std::size_t n = 0; n < patch.points.size(); ++n) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(mode % 3);
      const Eigen::Vector3d motion = mode < 3 ? axis : axis.cross(patch.points[n]).eval();
      u.segment<3>(3 * static_cast<Eigen::Index>(n)) = motion;
    }
    EXPECT_LT((k * u).cwiseAbs().maxCoeff(), 1e-12 * k.cwiseAbs().maxCoeff()) << "mode " << mode;
  }
}

TEST(Element, constant_strain_on_a_distorted_patch_is_exact) {
  const Patch patch = distorted_patch();
  const Eigen::MatrixXd k = patch.stiffness();
  Eigen::Matrix3d strain;
  strain << 1.0, 0.4, -0.3, 0.4, -0.7, 0.2, -0.3, 0.2, 0.5;
  Eigen::VectorXd exact(k.rows());
  std::map<int, double> boundary;
  for (std::size_t n = 0; n < patch.points.size(); ++n) {
    exact.segment<3>(3 * static_cast<Eigen::Index>(n)) = 1e-3 * strain * patch.points[n];
    const auto& at = patch.lattice[n];
    const bool outside = std::any_of(at.begin(), at.end(), [](int c) { return c == 0 || c == 4; });
    for (int c = 0; outside && c < 3; ++c)
      boundary[static_cast<int>(3 * n) + c] = exact[static_cast<Eigen::Index>(3 * n) + c];
  }
  const Eigen::VectorXd u = solve(k, Eigen::VectorXd::Zero(k.rows()), boundary);
  EXPECT_LT((u - exact).cwiseAbs().maxCoeff(), 1e-13 * 1e-3 * 1e2);
}

TEST(Element, has_the_six_rigid_and_the_six_known_zero_energy_patterns) {
  // 8 points × 6 strains = rank 48 of 60, as for C3D20R.
  ElementPoints points;
  for (int a = 0; a < 20; ++a)
    for (int d = 0; d < 3; ++d)
      points(a, d) = a < 8 ? corner[a][d] : 0.5 * (corner[edge[a - 8][0]][d] + corner[edge[a - 8][1]][d]);
  const Eigen::SelfAdjointEigenSolver<ElementStiffness> eigen(hexahedron_stiffness(points, steel));
  const auto& values = eigen.eigenvalues();
  EXPECT_LT(std::fabs(values[11]), 1e-12 * values[59]);
  EXPECT_LT(std::fabs(values[0]), 1e-12 * values[59]);
  EXPECT_GT(values[12], 1e-4 * values[59]);
}

TEST(Element, pure_bending_of_a_beam_is_exact) {
  // Curvature κ with free sides: u = κxy, v = −κ(x² − νy² + νz²)/2 … the quadratic solution lies in the
  // element's space.
  const double length = 8.0, height = 1.0, width = 0.6, kappa = 1e-4, nu = steel.poisson_ratio;
  const Patch beam({4, 2, 1}, [&](int i, int j, int k) {
    return Eigen::Vector3d(length * i / 4, height * (j - 1) / 2, width * (k - 0.5));
  });
  const Eigen::MatrixXd k = beam.stiffness();
  Eigen::VectorXd exact(k.rows());
  std::map<int, double> ends;
  for (std::size_t n = 0; n < beam.points.size(); ++n) {
    const Eigen::Vector3d& x = beam.points[n];
    exact.segment<3>(3 * static_cast<Eigen::Index>(n)) << kappa * x[0] * x[1],
        -kappa * (x[0] * x[0] + nu * (x[1] * x[1] - x[2] * x[2])) / 2.0, -nu * kappa * x[1] * x[2];
    if (beam.lattice[n][0] == 0 || beam.lattice[n][0] == 8)
      for (int c = 0; c < 3; ++c)
        ends[static_cast<int>(3 * n) + c] = exact[static_cast<Eigen::Index>(3 * n) + c];
  }
  const Eigen::VectorXd u = solve(k, Eigen::VectorXd::Zero(k.rows()), ends);
  EXPECT_LT((u - exact).cwiseAbs().maxCoeff(), 1e-10 * exact.cwiseAbs().maxCoeff());
}

TEST(Element, turning_an_element_turns_its_stiffness) {
  const Patch patch = distorted_patch();
  ElementPoints points;
  for (int a = 0; a < 20; ++a)
    points.row(a) = patch.points[static_cast<std::size_t>(patch.elements[0][static_cast<std::size_t>(a)])];
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.83, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  const ElementStiffness straight = hexahedron_stiffness(points, steel);
  const ElementStiffness turned = hexahedron_stiffness(points * turn.transpose(), steel);
  for (int a = 0; a < 20; ++a)
    for (int b = 0; b < 20; ++b)
      EXPECT_LT(
          (turned.block<3, 3>(3 * a, 3 * b) - turn * straight.block<3, 3>(3 * a, 3 * b) * turn.transpose())
              .norm(),
          1e-12 * straight.cwiseAbs().maxCoeff());
}

TEST(Element, inverted_shows_in_its_jacobian) {
  ElementPoints points;
  for (int a = 0; a < 20; ++a)
    for (int d = 0; d < 3; ++d)
      points(a, d) = a < 8 ? corner[a][d] : 0.5 * (corner[edge[a - 8][0]][d] + corner[edge[a - 8][1]][d]);
  EXPECT_NEAR(smallest_jacobian(points), 0.125, 1e-14);
  points.col(0) *= -1.0;
  EXPECT_LT(smallest_jacobian(points), 0.0);
}

} // namespace
} // namespace strainwave
