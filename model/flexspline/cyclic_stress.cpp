#include "strainwave/model/flexspline/cyclic_stress.hpp"

#include "strainwave/model/flexspline/cyclic_field.hpp"
#include "strainwave/model/flexspline/element.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

namespace strainwave {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Share of integration point g in corner c, both numbered as hexahedron_integration_points().
double corner_share(unsigned corner, unsigned point) {
  double share = 1.0;
  for (const unsigned axis : {1u, 2u, 4u})
    share *= 0.5 * (1.0 + ((corner ^ point) & axis ? -1.0 : 1.0) * std::sqrt(3.0));
  return share;
}

double von_mises(const Eigen::Matrix3d& stress) {
  const Eigen::Matrix3d deviator = stress - stress.trace() / 3.0 * Eigen::Matrix3d::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

} // namespace

MatrixXd largest_von_mises(const SectorMesh& mesh, const Material& material, const MatrixXd& displacement) {
  const double e_modulus = material.youngs_modulus_mpa, nu = material.poisson_ratio;
  const double lambda = e_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), mu = e_modulus / (2.0 * (1.0 + nu));
  const std::array<Eigen::Vector3d, 8> locals = hexahedron_integration_points();
  MatrixXd result(static_cast<Index>(mesh.ring_elements()), displacement.cols());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ElementPoints points = element_points(mesh, static_cast<int>(e));
    std::array<Eigen::Matrix<double, 20, 3>, 8> gradient;
    for (std::size_t g = 0; g < 8; ++g) {
      const Eigen::Matrix<double, 20, 3> by_local = hexahedron_shape_gradient(locals[g]);
      const Eigen::Matrix3d jacobian = by_local.transpose() * points;
      gradient[g] = by_local * jacobian.inverse().transpose();
    }
    for (int j = 0; j < mesh.sectors; ++j)
      for (Index c = 0; c < displacement.cols(); ++c) {
        const Eigen::Matrix<double, 60, 1> u = element_displacement(mesh, e, j, displacement.col(c));
        Eigen::Matrix<double, 3, 20> cartesian; // in the frame of sector 0: the stress does not see the turn
        for (Index a = 0; a < 20; ++a) {
          const double phi =
              mesh.nodes[static_cast<std::size_t>(mesh.elements[e][static_cast<std::size_t>(a)])].angle;
          cartesian.col(a) << std::cos(phi) * u[3 * a] - std::sin(phi) * u[3 * a + 1],
              std::sin(phi) * u[3 * a] + std::cos(phi) * u[3 * a + 1], u[3 * a + 2];
        }
        std::array<Eigen::Matrix3d, 8> stress;
        for (std::size_t g = 0; g < 8; ++g) {
          const Eigen::Matrix3d slope = cartesian * gradient[g]; // ∂u_i/∂x_j
          const Eigen::Matrix3d strain = 0.5 * (slope + slope.transpose());
          stress[g] = 2.0 * mu * strain + lambda * strain.trace() * Eigen::Matrix3d::Identity();
        }
        double largest = 0.0;
        for (unsigned corner = 0; corner < 8; ++corner) {
          Eigen::Matrix3d there = Eigen::Matrix3d::Zero();
          for (unsigned g = 0; g < 8; ++g)
            there += corner_share(corner, g) * stress[g];
          largest = std::max(largest, von_mises(there));
        }
        result(static_cast<Index>(j) * static_cast<Index>(mesh.elements.size()) + static_cast<Index>(e), c) =
            largest;
      }
  }
  return result;
}

} // namespace strainwave
