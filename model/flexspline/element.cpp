#include "strainwave/model/flexspline/element.hpp"

#include "strainwave/model/flexspline/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace strainwave {

namespace {

/// Signs of the nodes' local coordinates; 0 marks the direction of a mid-side node.
constexpr int signs[20][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1},
                              {1, -1, 1},   {1, 1, 1},   {-1, 1, 1}, {0, -1, -1}, {1, 0, -1},
                              {0, 1, -1},   {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},   {0, 1, 1},
                              {-1, 0, 1},   {-1, -1, 0}, {1, -1, 0}, {1, 1, 0},   {-1, 1, 0}};

} // namespace

Eigen::Matrix<double, 20, 1> hexahedron_shape(const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 20, 1> shape;
  for (int a = 0; a < 20; ++a) {
    double product = 1.0, sum = 0.0;
    for (int d = 0; d < 3; ++d) {
      const double along = p[d] * signs[a][d];
      product *= signs[a][d] == 0 ? 1.0 - p[d] * p[d] : 1.0 + along;
      sum += along;
    }
    shape[a] = a < 8 ? product * (sum - 2.0) / 8.0 : product / 4.0;
  }
  return shape;
}

Eigen::Matrix<double, 20, 3> hexahedron_shape_gradient(const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 20, 3> gradient;
  for (int a = 0; a < 20; ++a) {
    double factor[3], slope[3], sum = 0.0;
    for (int d = 0; d < 3; ++d) {
      const bool middle = signs[a][d] == 0;
      factor[d] = middle ? 1.0 - p[d] * p[d] : 1.0 + p[d] * signs[a][d];
      slope[d] = middle ? -2.0 * p[d] : signs[a][d];
      sum += p[d] * signs[a][d];
    }
    for (int d = 0; d < 3; ++d) {
      const double others = factor[(d + 1) % 3] * factor[(d + 2) % 3];
      gradient(a, d) =
          a < 8 ? others * (slope[d] * (sum - 2.0) + factor[d] * signs[a][d]) / 8.0 : others * slope[d] / 4.0;
    }
  }
  return gradient;
}

std::array<Eigen::Vector3d, 8> hexahedron_integration_points() {
  const double g = 1.0 / std::sqrt(3.0);
  std::array<Eigen::Vector3d, 8> points;
  for (unsigned n = 0; n < 8; ++n)
    points[n] = {n & 1 ? g : -g, n & 2 ? g : -g, n & 4 ? g : -g};
  return points;
}

ElementStiffness hexahedron_stiffness(const ElementPoints& points, const Material& material) {
  const double e = material.youngs_modulus_mpa, nu = material.poisson_ratio;
  const double lambda = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), mu = e / (2.0 * (1.0 + nu));
  ElementStiffness stiffness = ElementStiffness::Zero();
  for (const Eigen::Vector3d& local : hexahedron_integration_points()) {
    const Eigen::Matrix<double, 20, 3> by_local = hexahedron_shape_gradient(local);
    const Eigen::Matrix3d jacobian = by_local.transpose() * points; // ∂x_j/∂ξ_i
    const double volume = jacobian.determinant();
    const Eigen::Matrix<double, 20, 3> gradient = by_local * jacobian.inverse().transpose();
    for (int b = 0; b < 20; ++b)
      for (int a = 0; a <= b; ++a) {
        const Eigen::RowVector3d ga = gradient.row(a) * volume, gb = gradient.row(b);
        Eigen::Matrix3d block = lambda * ga.transpose() * gb + mu * gb.transpose() * ga;
        block.diagonal().array() += mu * ga.dot(gb);
        stiffness.block<3, 3>(3 * a, 3 * b) += block;
      }
  }
  stiffness.triangularView<Eigen::StrictlyLower>() = stiffness.transpose();
  return stiffness;
}

double smallest_jacobian(const ElementPoints& points) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto look = [&](const Eigen::Vector3d& local) {
    const Eigen::Matrix3d jacobian = hexahedron_shape_gradient(local).transpose() * points;
    smallest = std::min(smallest, jacobian.determinant());
  };
  for (const Eigen::Vector3d& local : hexahedron_integration_points()) {
    look(local);
    look(local * std::sqrt(3.0));
  }
  return smallest;
}

ElementPoints element_points(const SectorMesh& mesh, int element) {
  ElementPoints points;
  for (int a = 0; a < 20; ++a) {
    const CartesianPoint p =
        mesh.node(mesh.elements[static_cast<std::size_t>(element)][static_cast<std::size_t>(a)], 0);
    points.row(a) << p.x, p.y, p.z;
  }
  return points;
}

ElementStiffness cylindrical_stiffness(const SectorMesh& mesh, int element, const Material& material) {
  ElementStiffness stiffness = hexahedron_stiffness(element_points(mesh, element), material);
  std::array<Eigen::Matrix3d, 20> frame;
  for (std::size_t a = 0; a < 20; ++a) {
    const double phi =
        mesh.nodes[static_cast<std::size_t>(mesh.elements[static_cast<std::size_t>(element)][a])].angle;
    frame[a] << std::cos(phi), -std::sin(phi), 0.0, std::sin(phi), std::cos(phi), 0.0, 0.0, 0.0, 1.0;
  }
  for (int b = 0; b < 20; ++b)
    for (int a = 0; a <= b; ++a) {
      const Eigen::Matrix3d block = stiffness.block<3, 3>(3 * a, 3 * b);
      stiffness.block<3, 3>(3 * a, 3 * b) =
          frame[static_cast<std::size_t>(a)].transpose() * block * frame[static_cast<std::size_t>(b)];
    }
  stiffness.triangularView<Eigen::StrictlyLower>() = stiffness.transpose(); // the same bits on both sides
  return stiffness;
}

} // namespace strainwave
