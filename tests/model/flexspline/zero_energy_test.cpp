// Modes without energy: the 20-node element with 2 × 2 × 2 points has six of its own, and what holds it must
// end them.
//
// Judged from the strains at the integration points, whose singular values show such a mode at n ε; those of
// the stiffness are their squares and show it at √(n ε) only, where rounding decides whether a pivot is
// positive.

#include "strainwave/model/flexspline/element.hpp"
#include "strainwave/model/flexspline/mesh.hpp"
#include "tests/model/flexspline/bodies.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr int open_sector = -1; ///< both sides of the sector free, as it is condensed

/// √volume × strain (six components whose squares add up to ε : ε) of one element, by its Cartesian
/// displacements.
Eigen::MatrixXd element_strains(const ElementPoints& points) {
  Eigen::MatrixXd strain = Eigen::MatrixXd::Zero(48, 60);
  Eigen::Index row = 0;
  for (const Eigen::Vector3d& local : hexahedron_integration_points()) {
    const Eigen::Matrix<double, 20, 3> by_local = hexahedron_shape_gradient(local);
    const Eigen::Matrix3d jacobian = by_local.transpose() * points;
    const Eigen::Matrix<double, 20, 3> slope =
        by_local * jacobian.inverse().transpose() * std::sqrt(jacobian.determinant());
    for (int a = 0; a < 20; ++a)
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        strain(row + i, 3 * a + i) = slope(a, i);
        strain(row + 3 + i, 3 * a + i) = slope(a, j) / std::sqrt(2.0);
        strain(row + 3 + i, 3 * a + j) = slope(a, i) / std::sqrt(2.0);
      }
    row += 6;
  }
  return strain;
}

/// Strains of a sector by its free displacements in cylindrical frames; the right side is e^{iα} times the
/// left one.
Eigen::MatrixXcd sector_strains(const SectorMesh& mesh, int harmonic) {
  constexpr int free = 0, held = -1, tied = -2;
  std::vector<int> unknown(3 * mesh.nodes.size(), free);
  std::vector<std::complex<double>> phase(unknown.size(), 1.0);
  for (const int dof : mesh.fixed)
    unknown[static_cast<std::size_t>(dof)] = held;
  const auto each_tie = [&](const auto& work) {
    for (std::size_t b = 0; b < mesh.right.size() && harmonic != open_sector; ++b)
      for (int c = 0; c < 3; ++c)
        work(static_cast<std::size_t>(3 * mesh.right[b] + c), static_cast<std::size_t>(3 * mesh.left[b] + c));
  };
  each_tie([&](std::size_t right, std::size_t) {
    if (unknown[right] == free)
      unknown[right] = tied;
  });
  int size = 0;
  for (int& u : unknown)
    if (u == free)
      u = size++;
  each_tie([&](std::size_t right, std::size_t left) {
    if (unknown[right] == tied) {
      unknown[right] = unknown[left];
      phase[right] = std::polar(1.0, mesh.pitch_rad() * harmonic);
    }
  });
  Eigen::MatrixXcd strains =
      Eigen::MatrixXcd::Zero(48 * static_cast<Eigen::Index>(mesh.elements.size()), size);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Eigen::MatrixXd of_element = element_strains(element_points(mesh, static_cast<int>(e)));
    for (std::size_t a = 0; a < 20; ++a) {
      const auto node = static_cast<std::size_t>(mesh.elements[e][a]);
      const Eigen::AngleAxisd frame(mesh.nodes[node].angle, Eigen::Vector3d::UnitZ());
      const Eigen::MatrixXd turned =
          of_element.middleCols(static_cast<Eigen::Index>(3 * a), 3) * frame.toRotationMatrix();
      for (std::size_t c = 0; c < 3; ++c)
        if (const int u = unknown[3 * node + c]; u >= 0)
          strains.col(u).segment(48 * static_cast<Eigen::Index>(e), 48) +=
              phase[3 * node + c] * turned.col(static_cast<Eigen::Index>(c));
    }
  }
  return strains;
}

struct Modes {
  Eigen::Index without_energy = 0; ///< singular values below n ε times the largest
  double weakest = 0.0;            ///< least energy with every displacement scaled to unit energy of its own
  double safe = 0.0;               ///< above this every pivot is positive, in whatever order sums are rounded
};

Modes modes_of(const SectorMesh& mesh, int harmonic) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  Eigen::MatrixXcd strains = sector_strains(mesh, harmonic);
  const Eigen::Index n = strains.cols();
  strains.colwise().normalize();
  const Eigen::VectorXd values = Eigen::BDCSVD<Eigen::MatrixXcd>(strains).singularValues();
  Modes modes;
  modes.without_energy = n - (values.array() > static_cast<double>(n) * epsilon * values[0]).count();
  modes.weakest = values[n - 1] * values[n - 1];
  // Demmel 1989 (Higham, Accuracy and Stability, theorem 10.7): Cholesky of a matrix of unit diagonal runs to
  // its end when the least eigenvalue exceeds n (n + 1) u, u = ε/2.
  modes.safe = 0.5 * static_cast<double>(n * (n + 1)) * epsilon;
  return modes;
}

SectorMesh quarter_ring(bool all_rows_held) {
  SectorMesh mesh = testing_bodies::tube_mesh(
      {.inner = 13.856, .outer = 14.156, .bottom = 0.0, .top = 1.0, .sectors = 4, .around = 6});
  for (const auto* side : {&mesh.left, &mesh.right})
    for (const int node : *side)
      mesh.fixed.push_back(3 * node + 1);
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node)
    if (all_rows_held || mesh.nodes[static_cast<std::size_t>(node)].z == 0.5)
      mesh.fixed.push_back(3 * node + 2);
  return mesh;
}

TEST(ZeroEnergy, a_ring_of_one_element_has_a_mode_unless_its_section_is_held) {
  // The hourglass of the section, the same all around: held in the middle plane it is free.
  EXPECT_EQ(modes_of(quarter_ring(false), open_sector).without_energy, 1);
  const Modes held = modes_of(quarter_ring(true), open_sector);
  EXPECT_EQ(held.without_energy, 0);
  EXPECT_GT(held.weakest, held.safe);
}

/// The smallest legal counts: other patterns need them smaller, and more elements hold each other better.
Gear smallest_mesh() {
  Gear gear = seed_gear();
  gear.mesh = {.per_pitch = 3,
               .along_face = 2,
               .along_wall = 1,
               .diaphragm = 1,
               .tooth_height = 1,
               .through_thickness = 1};
  return gear;
}

/// The cup is condensed as an open sector, then closed for every harmonic; both held at the bore alone.
void expect_held(const Gear& gear, const Mesh& counts, const char* what) {
  const Outcome<SectorMesh> mesh = sector_mesh(gear.flexspline, counts);
  ASSERT_TRUE(mesh) << what << ": " << mesh.failure().message;
  for (const int harmonic : {open_sector, 0, 1, 2, mesh->sectors / 2}) {
    const Modes modes = modes_of(*mesh, harmonic);
    EXPECT_EQ(modes.without_energy, 0) << what << ", harmonic " << harmonic;
    EXPECT_GT(modes.weakest, modes.safe) << what << ", harmonic " << harmonic;
  }
}

TEST(ZeroEnergy, a_cup_held_at_its_bore_has_none_on_the_smallest_meshes) {
  const Gear gear = smallest_mesh();
  expect_held(gear, gear.mesh, "smallest mesh");
  expect_held(gear, coarser(gear.mesh, true), "its coarser companion");
  for (int Mesh::*count : {&Mesh::per_pitch, &Mesh::tooth_height}) {
    Mesh more = gear.mesh;
    ++(more.*count);
    expect_held(gear, more, "one count more");
    expect_held(gear, coarser(more, true), "its coarser companion");
  }
}

TEST(ZeroEnergy, a_cup_held_at_its_bore_has_none_at_the_ends_of_its_shape) {
  Gear gear = smallest_mesh();
  gear.flexspline.front_clearance_mm = 0.0;
  expect_held(gear, gear.mesh, "no front clearance");
  gear = smallest_mesh();
  gear.flexspline.wall_thickness_mm = gear.flexspline.root_radius_mm - gear.flexspline.neutral_radius_mm +
                                      gear.flexspline.rim_thickness_mm / 2.0;
  expect_held(gear, gear.mesh, "no step between wall and rim");
  gear = smallest_mesh();
  gear.flexspline.boss_radius_mm = 13.8;
  expect_held(gear, gear.mesh, "hardly a diaphragm");
  // Teeth with nearly parallel flanks: like boxes, whose patterns only their neighbours end.
  gear = smallest_mesh();
  gear.flexspline.pressure_angle_deg = 1.0;
  gear.flexspline.profile_shift = 0.0;
  for (const int height : {1, 2}) {
    gear.mesh.tooth_height = height;
    expect_held(gear, gear.mesh, "parallel flanks");
    expect_held(gear, coarser(gear.mesh, true), "parallel flanks, coarser");
  }
}

} // namespace
} // namespace strainwave
