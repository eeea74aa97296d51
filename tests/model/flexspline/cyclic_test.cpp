#include "strainwave/model/flexspline/cyclic.hpp"

#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/model/flexspline/ring.hpp"
#include "tests/model/flexspline/bodies.hpp"
#include "tests/model/flexspline/ring_solver.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace strainwave {
namespace {

double largest(const std::vector<double>& values) {
  double scale = 0.0;
  for (const double v : values)
    scale = std::max(scale, std::fabs(v));
  return scale;
}

/// Largest difference between cyclic responses and a full solution, relative to the largest response.
double difference_from_full_solution(const ResponseRequest& request, const std::vector<int>& columns) {
  const SectorMesh mesh =
      sector_mesh(request.flexspline, request.mesh, {request.teeth, request.sectors}).value();
  const ResponseFunctionals plan = response_functionals(request, mesh);
  UnitResponses cyclic = plan.layout;
  cyclic.data = cyclic_responses(mesh, request.material, plan.functionals);
  const RingPart ring(mesh);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * ring.nodes(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c)
    ring.add_load(plan.functionals[static_cast<std::size_t>(columns[c])], 0, 1.0,
                  force.col(static_cast<Eigen::Index>(c)));
  const Eigen::MatrixXd u = testing_support::RingSolver(ring, request.material).solve(force);
  double worst = 0.0;
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (int k = 0; k < mesh.sectors; ++k)
      for (int a = 0; a < cyclic.count(); ++a)
        worst = std::max(worst, std::fabs(cyclic(k, a, columns[c]) -
                                          ring.measure(plan.functionals[static_cast<std::size_t>(a)], k,
                                                       u.col(static_cast<Eigen::Index>(c)))));
  return worst / largest(cyclic.data);
}

TEST(Cyclic, equals_the_full_solution_on_a_cup_with_teeth) {
  const ResponseRequest request = testing_bodies::broad_toothed_cup();
  std::vector<int> every(static_cast<std::size_t>(
      response_functionals(request, sector_mesh(request.flexspline, request.mesh).value()).layout.count()));
  for (std::size_t n = 0; n < every.size(); ++n)
    every[n] = static_cast<int>(n);
  EXPECT_LT(difference_from_full_solution(request, every), 1e-10);
}

TEST(Cyclic, equals_the_full_solution_with_an_odd_number_of_sectors) {
  ResponseRequest request = testing_bodies::broad_toothed_cup();
  request.teeth = false;
  request.sectors = 15;
  request.wall_offset = {0.0, 0.25, 0.5, 0.9};
  EXPECT_LT(difference_from_full_solution(request, {0, 5, 13, 20}), 1e-10);
}

TEST(CyclicNightly, equals_the_full_solution_on_the_seed_ring) {
  ResponseRequest request = testing_bodies::seed_cup();
  request.mesh = coarser(request.mesh, true);
  EXPECT_LT(difference_from_full_solution(request, {0, 9, 10, 21, 30}), 1e-10);
}

TEST(Cyclic, responses_are_reciprocal) {
  // As solved; unit_responses() then replaces each pair by its mean and reports this difference.
  const ResponseRequest request = testing_bodies::broad_toothed_cup();
  const SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
  ResponseFunctionals plan = response_functionals(request, mesh);
  UnitResponses& solved = plan.layout;
  solved.data = cyclic_responses(mesh, request.material, plan.functionals);
  double worst = 0.0;
  const int n = solved.count();
  for (int k = 0; k < solved.sectors; ++k)
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        worst = std::max(worst, std::fabs(solved(k, a, b) - solved(-k, b, a)));
  EXPECT_LT(worst, 1e-12 * largest(solved.data));
  EXPECT_EQ(unit_responses(request).value().reciprocity_error, worst / largest(solved.data));
}

TEST(Cyclic, flank_compliance_is_positive_definite) {
  ResponseRequest request = testing_bodies::broad_toothed_cup();
  request.flank_heights = 3;
  request.face_slices = 3;
  const UnitResponses g = unit_responses(request).value();
  const int n = g.flank_count();
  Eigen::MatrixXd d(g.sectors * n, g.sectors * n);
  for (int i = 0; i < g.sectors; ++i)
    for (int j = 0; j < g.sectors; ++j)
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
          d(i * n + a, j * n + b) = g(i - j, a, b);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(d);
  EXPECT_GT(eigen.eigenvalues()[0], 1e-9 * d.cwiseAbs().maxCoeff()) << "rounding is 1e-12";
}

TEST(Cyclic, number_of_threads_does_not_change_a_bit) {
  const ResponseRequest request = testing_bodies::broad_toothed_cup();
  const std::vector<double> one = unit_responses(request, 1)->data;
  for (const int threads : {2, 3, 7})
    EXPECT_EQ(one, unit_responses(request, threads)->data) << threads;
}

TEST(Cyclic, turning_the_model_changes_nothing) {
  const ResponseRequest request = testing_bodies::broad_toothed_cup();
  SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
  const ResponseFunctionals plan = response_functionals(request, mesh);
  const std::vector<double> straight = cyclic_responses(mesh, request.material, plan.functionals);
  for (CylinderPoint& node : mesh.nodes)
    node.angle += 0.7391;
  const std::vector<double> turned = cyclic_responses(mesh, request.material, plan.functionals);
  double worst = 0.0;
  for (std::size_t n = 0; n < straight.size(); ++n)
    worst = std::max(worst, std::fabs(straight[n] - turned[n]));
  // Every entry of K is rounded anew; the free cup multiplies that by |K| |u|²/energy ≈ 10⁷
  // (condensation.hpp).
  EXPECT_LT(worst, 1e-8 * largest(straight));
}

TEST(Cyclic, a_sector_that_is_not_its_mirror_image_is_refused) {
  const ResponseRequest request = testing_bodies::broad_toothed_cup();
  SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
  const ResponseFunctionals plan = response_functionals(request, mesh);
  mesh.nodes[static_cast<std::size_t>(mesh.elements.back()[6])].angle += 1e-3;
  EXPECT_THROW((void)cyclic_responses(mesh, request.material, plan.functionals), NotPositiveStiffness);
}

TEST(Cyclic, a_stiffness_that_is_not_positive_definite_is_refused) {
  const ResponseRequest request = testing_bodies::broad_toothed_cup();
  const SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
  const ResponseFunctionals plan = response_functionals(request, mesh);
  const Material impossible{.youngs_modulus_mpa = -1.0, .poisson_ratio = 0.3};
  EXPECT_THROW((void)cyclic_responses(mesh, impossible, plan.functionals), NotPositiveStiffness);
}

TEST(Cyclic, stiffness_scales_out) {
  ResponseRequest request = testing_bodies::broad_toothed_cup();
  const std::vector<double> steel = unit_responses(request)->data;
  request.material.youngs_modulus_mpa *= 4.0; // a power of two: the same bits up to the exponent
  const std::vector<double> stiff = unit_responses(request)->data;
  for (std::size_t n = 0; n < steel.size(); ++n)
    ASSERT_NEAR(stiff[n], steel[n] / 4.0, 1e-13 * largest(steel));
}

TEST(Cyclic, a_point_pushed_outwards_at_the_open_end_flares_the_wall) {
  // Sign of the meridian tilt: the wall's normal leans towards −z where the radius grows with z.
  const UnitResponses g = unit_responses(testing_bodies::seed_cup()).value();
  const int last = static_cast<int>(g.wall_z_mm.size()) - 1, load = g.wall(0, last, UnitResponses::radial);
  EXPECT_GT(g(0, g.section(last, UnitResponses::section_radial), load),
            g(0, g.section(0, UnitResponses::section_radial), load));
  const double slope = (g(0, g.section(last, UnitResponses::section_radial), load) -
                        g(0, g.section(0, UnitResponses::section_radial), load)) /
                       (g.section_z_mm.back() - g.section_z_mm.front());
  EXPECT_NEAR(g(0, g.section(last / 2, UnitResponses::section_tilt), load), -slope, 0.1 * slope);
}

TEST(Cyclic, impossible_requests_have_a_sentence) {
  const auto message = [](void (*change)(ResponseRequest&)) {
    ResponseRequest request = testing_bodies::broad_toothed_cup();
    change(request);
    const Outcome<UnitResponses> outcome = unit_responses(request);
    return outcome.ok() ? std::string("no failure") : outcome.failure().message;
  };
  EXPECT_NE(message([](ResponseRequest& r) { r.flank_heights = 1; }).find("flank_heights"),
            std::string::npos);
  EXPECT_NE(message([](ResponseRequest& r) { r.flank_heights = 6; }).find("tooth_height = 3"),
            std::string::npos);
  EXPECT_NE(message([](ResponseRequest& r) { r.face_slices = 7; }).find("along_face = 3"), std::string::npos);
  EXPECT_NE(message([](ResponseRequest& r) { r.wall_offset = {1.0}; }).find("station"), std::string::npos);
  EXPECT_NE(message([](ResponseRequest& r) { r.wall_z_mm = {29.0}; }).find("29"), std::string::npos);
  EXPECT_NE(message([](ResponseRequest& r) {
              r.section_z_mm = {25.0, 24.0};
            }).find("ascend"),
            std::string::npos);
  EXPECT_NE(message([](ResponseRequest& r) { r.material.poisson_ratio = 0.5; }).find("elastic"),
            std::string::npos);
  EXPECT_NE(message([](ResponseRequest& r) { r.flexspline.tip_radius_mm = 14.0; }).find("tip"),
            std::string::npos);
}

} // namespace
} // namespace strainwave
