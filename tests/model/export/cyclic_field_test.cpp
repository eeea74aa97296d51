// Displacements of the whole ring from one sector, against the factorization of the whole ring.

#include "strainwave/model/flexspline/cyclic_field.hpp"
#include "strainwave/model/flexspline/cyclic_stress.hpp"

#include "strainwave/model/export/cup_grid.hpp"
#include "strainwave/model/flexspline/cyclic.hpp"
#include "strainwave/model/flexspline/ring.hpp"
#include "tests/model/flexspline/bodies.hpp"
#include "tests/model/flexspline/ring_solver.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

struct Cup {
  ResponseRequest request = testing_bodies::broad_toothed_cup();
  SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
  ResponseFunctionals plan = response_functionals(request, mesh);
  const Functional& flank(int height, int direction) const {
    return plan.functionals[static_cast<std::size_t>(plan.layout.flank(height, 0, direction))];
  }
  const Functional& wall(int station, int direction) const {
    return plan.functionals[static_cast<std::size_t>(plan.layout.wall(station, 1, direction))];
  }
  /// Loads without any symmetry; one with a part on the next sector, across the ring's seam too.
  std::vector<std::vector<FieldLoad>> cases() const {
    return {{{&flank(2, 0), 0, 1.0}, {&flank(1, 1), 7, -0.4}, {&wall(1, 1), 19, 2.0}},
            {{&wall(0, 0), 3, 1.0}, {&wall(1, 0), 4, 0.3}}};
  }
};

TEST(CyclicField, equals_the_solution_of_the_whole_ring) {
  const Cup cup;
  const std::vector<std::vector<FieldLoad>> cases = cup.cases();
  const RingField field = ring_field(cup.mesh, cup.request.material, cases);
  const RingPart ring(cup.mesh);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * ring.nodes(), 2);
  for (std::size_t c = 0; c < 2; ++c)
    for (const FieldLoad& load : cases[c])
      ring.add_load(*load.functional, load.sector, load.factor, force.col(static_cast<Eigen::Index>(c)));
  const Eigen::MatrixXd full = testing_support::RingSolver(ring, cup.request.material).solve(force);
  ASSERT_EQ(field.displacement.rows(), full.rows());
  EXPECT_LT((field.force - force).cwiseAbs().maxCoeff(), 1e-15); // rounding of sums
  // Both lose about log10(condition of a thin cup) ≈ 7 digits of 16.
  EXPECT_LT((field.displacement - full).cwiseAbs().maxCoeff(), 1e-8 * full.cwiseAbs().maxCoeff());
}

TEST(CyclicField, is_in_equilibrium) {
  const Cup cup;
  EXPECT_LT(ring_field(cup.mesh, cup.request.material, cup.cases()).residual, 1e-8);
}

TEST(CyclicField, odd_number_of_sectors_is_solved_too) {
  Cup cup;
  cup.request.flexspline.teeth = 19;
  cup.mesh = sector_mesh(cup.request.flexspline, cup.request.mesh).value();
  cup.plan = response_functionals(cup.request, cup.mesh);
  const std::vector<std::vector<FieldLoad>> cases = {
      {{&cup.flank(0, 0), 18, 1.0}, {&cup.wall(1, 1), 18, 1.0}}};
  EXPECT_LT(ring_field(cup.mesh, cup.request.material, cases).residual, 1e-8);
}

TEST(LargestVonMises, uniform_strain_gives_its_closed_form_in_every_element) {
  const Cup cup;
  const double e = cup.request.material.youngs_modulus_mpa, nu = cup.request.material.poisson_ratio;
  // Uniaxial stress s along x: ε = s/E (1, −ν, −ν); von Mises stress = |s|.
  const double s = 123.0;
  Eigen::MatrixXd u(3 * static_cast<Eigen::Index>(cup.mesh.ring_nodes()), 1);
  for (int j = 0; j < cup.mesh.sectors; ++j)
    for (int i = 0; i < static_cast<int>(cup.mesh.nodes.size()); ++i) {
      const CartesianPoint p = cup.mesh.node(i, j);
      const double phi = cup.mesh.angle(i, j), ux = s / e * p.x, uy = -nu * s / e * p.y;
      const Eigen::Index at = 3 * cup.mesh.ring_node(i, j);
      u(at, 0) = std::cos(phi) * ux + std::sin(phi) * uy;
      u(at + 1, 0) = std::cos(phi) * uy - std::sin(phi) * ux;
      u(at + 2, 0) = -nu * s / e * p.z;
    }
  const Eigen::MatrixXd stress = largest_von_mises(cup.mesh, cup.request.material, u);
  EXPECT_EQ(stress.rows(), static_cast<Eigen::Index>(cup.mesh.ring_elements()));
  EXPECT_NEAR(stress.minCoeff(), s, 1e-9 * s);
  EXPECT_NEAR(stress.maxCoeff(), s, 1e-9 * s);
}

} // namespace
} // namespace strainwave
