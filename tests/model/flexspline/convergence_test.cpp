// Refinement of the seed cup: D converges, and how fast.

#include "strainwave/model/flexspline/responses.hpp"
#include "tests/model/flexspline/bodies.hpp"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

namespace strainwave {
namespace {

UnitResponses on_mesh(const Mesh& mesh) {
  ResponseRequest request = testing_bodies::seed_cup();
  request.flank_heights = 3;
  request.wall_z_mm = {22.5, 26.5};
  request.sections = false;
  request.mesh = mesh;
  return unit_responses(request).value();
}

Mesh times(const Mesh& m, int factor) {
  return {.per_pitch = factor * m.per_pitch,
          .along_face = factor * m.along_face,
          .along_wall = factor * m.along_wall,
          .diaphragm = factor * m.diaphragm,
          .tooth_height = factor * m.tooth_height,
          .through_thickness = factor * m.through_thickness};
}

/// Largest difference of flank responses over their largest; of the sums over both lobes with `pair`.
double difference(const UnitResponses& a, const UnitResponses& b, bool pair) {
  double worst = 0.0, scale = 0.0;
  const int half = a.sectors / 2;
  for (int k = 0; k < a.sectors; ++k)
    for (int p = 0; p < a.flank_count(); ++p)
      for (int q = 0; q < a.flank_count(); ++q) {
        const double left = a(k, p, q) + (pair ? a(k + half, p, q) : 0.0);
        const double right = b(k, p, q) + (pair ? b(k + half, p, q) : 0.0);
        worst = std::max(worst, std::fabs(left - right));
        scale = std::max(scale, std::fabs(right));
      }
  return worst / scale;
}

TEST(Convergence, estimate_of_the_default_mesh_is_a_few_percent) {
  ResponseRequest request = testing_bodies::seed_cup();
  request.estimate = true;
  const double estimate = unit_responses(request)->discretisation_estimate;
  EXPECT_GT(estimate, 0.005);
  EXPECT_LT(estimate, 0.05);
}

TEST(ConvergenceNightly, estimate_is_within_a_factor_of_two_of_the_truth) {
  ResponseRequest request = testing_bodies::seed_cup();
  request.flank_heights = 3;
  request.wall_z_mm = {22.5, 26.5};
  request.sections = false;
  request.estimate = true;
  const UnitResponses ours = unit_responses(request).value();
  // A mesh twice as fine in every direction has a quarter of the error (order 2.15), so the difference is 3/4
  // of it.
  const double error = difference(ours, on_mesh(times(request.mesh, 2)), false) / 0.75;
  EXPECT_GT(ours.discretisation_estimate, error / 2.0);
  EXPECT_LT(ours.discretisation_estimate, error * 2.0);
}

TEST(ConvergenceNightly, flank_responses_converge_under_refinement) {
  // Measured: 2.15 for single responses (bending of wall and diaphragm), 1.17 for the pair sums: the tooth's
  // sharp foot is a re-entrant corner of 270° with displacements like r^0.54, energies converge like (mesh
  // size)^1.09 (Williams 1952).
  const Mesh coarse{.per_pitch = 4,
                    .along_face = 3,
                    .along_wall = 7,
                    .diaphragm = 4,
                    .tooth_height = 1,
                    .through_thickness = 1};
  const UnitResponses one = on_mesh(coarse), two = on_mesh(times(coarse, 2)),
                      four = on_mesh(times(coarse, 4));
  const auto order = [&](bool pair) {
    const double first = difference(one, two, pair), second = difference(two, four, pair);
    std::printf("%s: 1 to 2 %.3e, 2 to 4 %.3e, order %.2f\n", pair ? "both lobes" : "one lobe", first, second,
                std::log2(first / second));
    return std::log2(first / second);
  };
  EXPECT_GT(order(false), 1.5);
  EXPECT_GT(order(true), 1.0);
}

} // namespace
} // namespace strainwave
