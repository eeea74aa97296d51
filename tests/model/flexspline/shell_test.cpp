// Rings and cylinders with closed solutions: tests/reference/benchmarks.json.

#include "strainwave/model/flexspline/cyclic.hpp"
#include "strainwave/model/flexspline/ring.hpp"
#include "tests/model/flexspline/bodies.hpp"
#include "tests/model/flexspline/ring_solver.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace strainwave {
namespace {

nlohmann::json benchmarks() {
  std::ifstream in(STRAINWAVE_TEST_REFERENCE "/benchmarks.json");
  return nlohmann::json::parse(in);
}

TEST(Shell, thin_ring_under_two_opposed_loads) {
  // A quarter of the ring, its cut ends guided, plane (ν = 0: no axial displacement in the closed solution
  // either; held in the middle only, a section of one element would keep a mode without energy,
  // zero_energy_test.cpp). Radial load P/2 uniform over the cut at φ = 0 (the sector's left side),
  // displacement there as the same mean. Curved-beam corrections (Roark & Young, table for
  // circular rings, case 1), ν = 0:
  //   shortening (π/4 k1 − 2 k2²/π), growth (k1/2 − k2 + 2 k2²/π), k1 = 1 − α + β, k2 = 1 − α,
  //   α = t²/12R², β = 2.4 α.
  const double radius = 14.006, t = 0.3, width = 1.0, e = 206000.0, load = 1.0;
  SectorMesh mesh = testing_bodies::tube_mesh({.inner = radius - t / 2,
                                               .outer = radius + t / 2,
                                               .bottom = 0.0,
                                               .top = width,
                                               .sectors = 4,
                                               .around = 24,
                                               .layers = 1,
                                               .rows = 1});
  for (const auto* side : {&mesh.left, &mesh.right})
    for (const int node : *side)
      mesh.fixed.push_back(3 * node + 1);
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node)
    mesh.fixed.push_back(3 * node + 2);
  const auto mean =
      [&](const std::vector<int>& side) { // consistent weights of an 8-node side: corners −1/12, middles 1/3
        Functional functional;
        for (const int node : side) {
          const CylinderPoint& p = mesh.nodes[static_cast<std::size_t>(node)];
          const bool middle = p.z == width / 2 || std::fabs(p.radius - radius) < 1e-9;
          functional.here.add(3 * node, middle ? 1.0 / 3.0 : -1.0 / 12.0);
        }
        return functional;
      };
  const RingPart quarter(mesh, 1);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * quarter.nodes(), 1);
  quarter.add_load(mean(mesh.left), 0, load / 2.0, force.col(0));
  const Eigen::MatrixXd u =
      testing_support::RingSolver(quarter, {.youngs_modulus_mpa = e, .poisson_ratio = 0.0}).solve(force);
  const double unit = load * radius * radius * radius / (e * width * t * t * t / 12.0);
  const double alpha = t * t / (12.0 * radius * radius), k1 = 1.0 + 1.4 * alpha, k2 = 1.0 - alpha;
  const nlohmann::json ring = benchmarks()["ring"];
  const double pi = std::numbers::pi;
  const double thick_shorten = pi / 4 * k1 - 2 * k2 * k2 / pi - (pi / 4 - 2 / pi);
  const double thick_grow = k1 / 2 - k2 + 2 * k2 * k2 / pi - (2 / pi - 0.5);
  const double pulled = 2.0 * quarter.measure(mean(mesh.left), 0, u.col(0)) / unit;
  const double drawn_in = -2.0 * quarter.measure(mean(mesh.right), 0, u.col(0)) / unit;
  EXPECT_NEAR(pulled, ring["shorten"].get<double>() + thick_shorten, 1e-3 * pulled);
  EXPECT_NEAR(drawn_in, ring["grow"].get<double>() + thick_grow, 1e-3 * drawn_in);
}

/// Displacement at 90° of the cylinder of benchmarks.json under opposed unit loads, ends on rigid diaphragms.
double cylinder_w90(int sectors, int around, int rows) {
  const nlohmann::json data = benchmarks()["our_cylinder"];
  const double radius = data["R"], t = data["t"], length = data["L"];
  SectorMesh mesh = testing_bodies::tube_mesh({.inner = radius - t / 2,
                                               .outer = radius + t / 2,
                                               .bottom = -length / 2,
                                               .top = length / 2,
                                               .sectors = sectors,
                                               .around = around,
                                               .layers = 1,
                                               .rows = rows});
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
    const double z = mesh.nodes[static_cast<std::size_t>(node)].z;
    if (std::fabs(std::fabs(z) - length / 2) < 1e-9) {
      mesh.fixed.push_back(3 * node);
      mesh.fixed.push_back(3 * node + 1);
    }
    if (std::fabs(z) < 1e-9)
      mesh.fixed.push_back(3 * node + 2); // symmetry of the load about mid-length
  }
  const std::vector<Functional> point = {{point_functionals(mesh, {radius, 0.0, 0.0}).radial, {}}};
  const std::vector<double> g =
      cyclic_responses(mesh, {.youngs_modulus_mpa = data["E"], .poisson_ratio = data["nu"]}, point);
  const auto quarter = static_cast<std::size_t>(sectors / 4);
  return g[quarter] + g[3 * quarter];
}

TEST(Shell, cylinder_of_the_seed_cup_pinched_at_mid_length) {
  // Flügge's shell has no transverse shear and no load footprint; 90° away both are below the tolerance of
  // 0.5 %.
  const double flugge = benchmarks()["our_cylinder"]["w90_flugge"];
  EXPECT_NEAR(cylinder_w90(80, 2, 28), flugge, 0.005 * flugge);
}

TEST(Shell, cylinder_answers_alike_for_any_number_of_sectors) {
  // The same elements grouped into other sectors, the load in the middle of an element each time; rounding of
  // K times 10⁷.
  const double fine = cylinder_w90(80, 1, 10);
  EXPECT_NEAR(cylinder_w90(16, 5, 10), fine, 1e-8 * fine);
}

} // namespace
} // namespace strainwave
