#include "strainwave/model/flexspline/functionals.hpp"

#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/model/flexspline/ring.hpp"
#include "tests/model/flexspline/bodies.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace strainwave {
namespace {

/// Resultant along the axis, in the plane, and moment about the axis of nodal forces in cylindrical frames.
struct Resultant {
  double x = 0.0, y = 0.0, z = 0.0, moment = 0.0, radial_sum = 0.0;
};
Resultant resultant(const SectorMesh& mesh, const Functional& functional) {
  Resultant sum;
  for (const auto& [weights, sector] : {std::pair{&functional.here, 0}, std::pair{&functional.next, 1}})
    for (std::size_t n = 0; n < weights->dof.size(); ++n) {
      const int node = weights->dof[n] / 3, c = weights->dof[n] % 3;
      const double angle = mesh.angle(node, sector), f = weights->weight[n];
      sum.x += c == 0 ? f * std::cos(angle) : c == 1 ? -f * std::sin(angle) : 0.0;
      sum.y += c == 0 ? f * std::sin(angle) : c == 1 ? f * std::cos(angle) : 0.0;
      sum.z += c == 2 ? f : 0.0;
      sum.moment += c == 1 ? f * mesh.nodes[static_cast<std::size_t>(node)].radius : 0.0;
    }
  return sum;
}

class SeedFunctionals : public ::testing::Test {
protected:
  SeedFunctionals()
      : request(testing_bodies::seed_cup()), mesh(sector_mesh(request.flexspline, request.mesh).value()) {
    plan = response_functionals(request, mesh);
  }
  const Functional& flank(int height, int direction) const {
    return plan.functionals[static_cast<std::size_t>(plan.layout.flank(height, 0, direction))];
  }
  const Functional& wall(int station, int row, int direction) const {
    return plan.functionals[static_cast<std::size_t>(plan.layout.wall(station, row, direction))];
  }
  ResponseRequest request;
  SectorMesh mesh;
  ResponseFunctionals plan;
};

TEST_F(SeedFunctionals, layout_counts_what_is_there) {
  EXPECT_EQ(plan.functionals.size(), static_cast<std::size_t>(plan.layout.count()));
  EXPECT_EQ(plan.layout.count(), 2 * 5 + 2 * 2 * 7 + 4 * 7);
}

TEST_F(SeedFunctionals, flank_loads_are_unit_resultants_at_the_mean_radius_of_their_hat) {
  // Circumferential traction: moment = ∫ w ρ dA / ∫ w dA, between the hat's ends; a full hat's mean is its
  // peak to the second order of its width (flank length per radius varies slowly).
  for (int height = 0; height < 5; ++height) {
    const double peak = plan.layout.flank_radius_mm[static_cast<std::size_t>(height)];
    const Resultant force = resultant(mesh, flank(height, UnitResponses::circumferential));
    EXPECT_NEAR(std::hypot(force.x, force.y), 1.0,
                1e-4); // the directions e_φ of one hat differ by up to 0.008 rad
    const double third = 0.107 / 3.0;
    const double mean = height == 0 ? peak + third : height == 4 ? peak - third : peak;
    EXPECT_NEAR(force.moment, mean, 2e-3);
    EXPECT_NEAR(force.moment, plan.layout.flank_centre_mm[static_cast<std::size_t>(height)], 1e-12);
    const Resultant outwards = resultant(mesh, flank(height, UnitResponses::radial));
    EXPECT_NEAR(std::hypot(outwards.x, outwards.y), 1.0, 1e-4);
    EXPECT_NEAR(outwards.moment, 0.0,
                1e-4); // radial lines meet the axis; only the quadratic sides do not exactly
  }
}

TEST_F(SeedFunctionals, wall_loads_are_unit_resultants_centred_on_their_station_and_row) {
  const double pitch = mesh.pitch_rad();
  for (int station = 0; station < 2; ++station)
    for (int row = 0; row < 7; ++row) {
      const Functional& radial = wall(station, row, UnitResponses::radial);
      const Resultant force = resultant(mesh, radial);
      // ∫ hat cos(φ − φ0) = 1 − pitch²/4/12 …: the mean of cos over a hat of half width pitch/2.
      EXPECT_NEAR(std::hypot(force.x, force.y), 1.0 - pitch * pitch / 48.0, 1e-7);
      EXPECT_NEAR(std::atan2(force.y, force.x), station * pitch / 2.0, 1e-9);
      EXPECT_NEAR(resultant(mesh, wall(station, row, UnitResponses::circumferential)).moment, 13.856, 1e-5);
      double centre = 0.0, sum = 0.0;
      for (const auto* part : {&radial.here, &radial.next})
        for (std::size_t n = 0; n < part->dof.size(); ++n)
          if (part->dof[n] % 3 == 0) {
            centre += part->weight[n] * mesh.nodes[static_cast<std::size_t>(part->dof[n] / 3)].z;
            sum += part->weight[n];
          }
      EXPECT_NEAR(centre / sum, plan.layout.wall_z_mm[static_cast<std::size_t>(row)], 1e-9);
    }
}

TEST_F(SeedFunctionals, stations_between_teeth_span_two_sectors) {
  EXPECT_TRUE(wall(0, 3, UnitResponses::radial).next.dof.empty());
  EXPECT_FALSE(wall(1, 3, UnitResponses::radial).next.dof.empty());
}

TEST(CoastFunctionals, responses_of_both_flanks_are_those_of_a_cup_that_is_its_own_mirror_image) {
  ResponseRequest request = testing_bodies::broad_toothed_cup();
  request.flank_heights = 3;
  request.face_slices = 2;
  request.estimate = false;
  const UnitResponses drive_alone = unit_responses(request, 1).value();
  request.both_flanks = true;
  const UnitResponses both = unit_responses(request, 1).value();
  ASSERT_EQ(both.count(), drive_alone.count() + drive_alone.flank_count());
  double scale = 0.0;
  for (const double g : both.data)
    scale = std::max(scale, std::fabs(g));
  const auto coast = [&](int a) { return both.coast(0, 0, 0) + a; };
  const auto turned = [](int a) { return a % 2 == UnitResponses::circumferential ? -1.0 : 1.0; };
  for (int k = 0; k < both.sectors; ++k)
    for (int a = 0; a < both.flank_count(); ++a) {
      for (int b = 0; b < both.flank_count(); ++b) {
        EXPECT_NEAR(both(k, a, b), drive_alone(k, a, b), 1e-12 * scale);
        EXPECT_NEAR(both(k, coast(a), coast(b)), turned(a) * turned(b) * both(-k, a, b), 1e-12 * scale);
        EXPECT_NEAR(both(k, coast(a), b), turned(a) * turned(b) * both(-k, a, coast(b)), 1e-12 * scale);
      }
      // wall under the tooth centre (station 0), whose mirror image is that of sector −k
      for (int row = 0; row < static_cast<int>(both.wall_z_mm.size()); ++row)
        for (int direction = 0; direction < 2; ++direction) {
          const int w = both.wall(0, row, direction);
          EXPECT_NEAR(both(k, w, coast(a)), turned(direction) * turned(a) * both(-k, w, a), 1e-12 * scale);
        }
    }
}

TEST_F(SeedFunctionals, section_functionals_measure_a_known_displacement_field) {
  // u = (a r + b z) e_r + (c r + d r²) e_φ + (e + f r) e_z: at the neutral radius r = 14.006 under the tooth.
  const double a = 1e-4, b = 2e-4, c = 3e-4, d = 4e-5, e = 5e-3, f = 6e-4;
  Eigen::VectorXd u(static_cast<Eigen::Index>(3 * mesh.nodes.size()));
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const CylinderPoint& p = mesh.nodes[n];
    u.segment<3>(static_cast<Eigen::Index>(3 * n)) << a * p.radius + b * p.z,
        c * p.radius + d * p.radius * p.radius, e + f * p.radius;
  }
  const auto measured = [&](int row, int quantity) {
    const SectorWeights& w =
        plan.functionals[static_cast<std::size_t>(plan.layout.section(row, quantity))].here;
    double sum = 0.0;
    for (std::size_t n = 0; n < w.dof.size(); ++n)
      sum += w.weight[n] * u[w.dof[n]];
    return sum;
  };
  for (int row = 0; row < 7; ++row) {
    const double z = plan.layout.section_z_mm[static_cast<std::size_t>(row)], r = 14.006;
    EXPECT_NEAR(measured(row, UnitResponses::section_radial), a * r + b * z, 1e-12);
    EXPECT_NEAR(measured(row, UnitResponses::section_circumferential), c * r + d * r * r, 1e-12);
    EXPECT_NEAR(measured(row, UnitResponses::section_rotation), c + 2.0 * d * r, 1e-11);
    EXPECT_NEAR(measured(row, UnitResponses::section_tilt), f, 1e-11);
  }
}

TEST(Functionals, hats_of_a_flank_add_up_to_the_uniform_traction) {
  ResponseRequest request = testing_bodies::broad_toothed_cup();
  const SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
  const double root = request.flexspline.root_radius_mm, tip = request.flexspline.tip_radius_mm;
  const Functional uniform = flank_hat(mesh, {.constant = true}, {.constant = true}).circumferential;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * mesh.nodes.size()));
  // Uniform load = Σ (area share of a hat) × (its unit load); shares from least squares must be a partition.
  std::vector<Eigen::VectorXd> hats;
  for (int h = 0; h < 4; ++h)
    for (int s = 0; s < 3; ++s) {
      const Functional hat =
          flank_hat(mesh, equidistant_hat(root, tip, 4, h), equidistant_hat(21.5, 27.5, 3, s))
              .circumferential;
      Eigen::VectorXd force = Eigen::VectorXd::Zero(sum.size());
      for (std::size_t n = 0; n < hat.here.dof.size(); ++n)
        force[hat.here.dof[n]] += hat.here.weight[n];
      hats.push_back(force);
    }
  Eigen::MatrixXd basis(sum.size(), static_cast<Eigen::Index>(hats.size()));
  for (std::size_t n = 0; n < hats.size(); ++n)
    basis.col(static_cast<Eigen::Index>(n)) = hats[n];
  for (std::size_t n = 0; n < uniform.here.dof.size(); ++n)
    sum[uniform.here.dof[n]] += uniform.here.weight[n];
  const Eigen::VectorXd share = basis.completeOrthogonalDecomposition().solve(sum);
  EXPECT_LT((basis * share - sum).norm(), 1e-10 * sum.norm());
}

} // namespace
} // namespace strainwave
