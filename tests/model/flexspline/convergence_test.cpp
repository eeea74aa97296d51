// Refinement of the seed cup: D converges, and how fast.

#include "bodies.hpp"
#include "model/flexspline/responses.hpp"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

namespace strainwave {
namespace {

UnitResponses on_mesh(int factor) {
  ResponseRequest request = testing_bodies::seed_cup();
  const double rear = 21.5, front = 27.5;
  request.wall_z_mm = {rear, 0.5 * (rear + front), front};
  request.sections = false;
  Mesh& m = request.mesh;
  m = {.per_pitch = 4 * factor,
       .along_face = 3 * factor,
       .along_wall = 7 * factor,
       .diaphragm = 4 * factor,
       .tooth_height = factor,
       .through_thickness = factor};
  return unit_responses(request).value();
}

double difference(const UnitResponses& a, const UnitResponses& b) {
  double worst = 0.0, scale = 0.0;
  for (int k = 0; k < a.sectors; ++k)
    for (int p = 0; p < a.flank_count(); ++p)
      for (int q = 0; q < a.flank_count(); ++q) {
        worst = std::max(worst, std::fabs(a(k, p, q) - b(k, p, q)));
        scale = std::max(scale, std::fabs(b(k, p, q)));
      }
  return worst / scale;
}

TEST(Convergence, estimate_of_the_default_mesh_is_a_few_percent) {
  ResponseRequest request = testing_bodies::seed_cup();
  request.estimate = true;
  const double estimate = unit_responses(request)->discretisation_estimate;
  EXPECT_GT(estimate, 0.001);
  EXPECT_LT(estimate, 0.05);
}

TEST(ConvergenceNightly, flank_responses_converge_under_refinement) {
  const UnitResponses one = on_mesh(1), two = on_mesh(2), four = on_mesh(4);
  const double first = difference(one, two), second = difference(two, four);
  std::printf("flank responses: 1→2 %.3e, 2→4 %.3e, order %.2f\n", first, second, std::log2(first / second));
  EXPECT_GT(std::log2(first / second), 0.9);
}

} // namespace
} // namespace strainwave
