// The evaluator of real gears, on a coarse cup that is solved in a moment.

#include "strainwave/common/threads/parallel.hpp"
#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/optimize/gear/gear_evaluator.hpp"
#include "tests/support/coarse_seed.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

Gear coarse_gear() {
  return testing_support::coarse_seed_gear(testing_support::two_row_mesh);
}

DesignSpace u0_design() {
  return DesignSpace({{.path = NumberPath("wave_generator.max_radial_deformation_mm"),
                       .lower = 0.15,
                       .upper = 0.21,
                       .start = 0.2,
                       .links = {{NumberPath("wave_generator.eccentricity_mm"), 3.0}}}});
}

double value(const Evaluation& evaluation, std::string_view name) {
  return evaluation.values[*find_response(gear_responses(), name)];
}

GearEvaluator make(std::vector<Load> loads) {
  return GearEvaluator(coarse_gear(), u0_design(), std::move(loads), {.disk_cache = false});
}

TEST(GearEvaluator, GivesWhatTheForwardModelGives) {
  GearEvaluator evaluator = make({{.torque_nm = {7.0}, .rotation_rad = {}}});
  const Evaluation e = evaluator.evaluate(std::vector{0.2});
  Gear gear = coarse_gear();
  gear.wave_generator.eccentricity_mm = 3.0 * 0.2;
  gear.load.torque_nm = {7.0};
  const ForwardResult direct = ForwardModel({.disk_cache = false}).analyze(gear);
  ASSERT_TRUE(e.ok) << e.message;
  EXPECT_EQ(value(e, "peak_force_n"), direct.load[0].peak_force_n);
  EXPECT_EQ(value(e, "rotation_rad"), direct.load[0].rotation_rad);
  EXPECT_EQ(value(e, "secant_nm_per_rad"), direct.stiffness->secant_nm_per_rad);
  EXPECT_EQ(value(e, "min_backlash_um"), direct.backlash->min_um);
  EXPECT_TRUE(std::isnan(value(e, "transmission_error_arcsec"))); // one phase
  EXPECT_TRUE(e.certificate.holds());
}

TEST(GearEvaluator, AnyNumberOfThreadsSolvesACupOnce) {
  for (const int threads : {1, 4}) {
    const auto model =
        std::make_shared<const ForwardModel>(ForwardOptions{.disk_cache = false, .threads = 1});
    GearEvaluator one(coarse_gear(), u0_design(), {{.torque_nm = {7.0}, .rotation_rad = {}}}, model);
    GearEvaluator other(coarse_gear(), u0_design(), {{.torque_nm = {5.0}, .rotation_rad = {}}}, model);
    const std::uint64_t before = cups_solved();
    parallel_for(6, threads, [&](std::size_t k) {
      const std::vector x{0.196 + 0.001 * static_cast<double>(k)};
      EXPECT_TRUE(one.evaluate(x).ok);
      EXPECT_TRUE(other.evaluate(x).ok);
      EXPECT_FALSE(one.gradient(x).empty());
    });
    EXPECT_EQ(cups_solved() - before, 1u) << threads;
  }
}

TEST(GearEvaluator, OddNumberOfTeethKeepsBothLobesApart) {
  Gear gear = coarse_gear();
  gear.flexspline.teeth = 141;
  gear.circular_spline.teeth = 143;
  for (double* radius :
       {&gear.flexspline.tip_radius_mm, &gear.flexspline.root_radius_mm, &gear.flexspline.neutral_radius_mm,
        &gear.circular_spline.tip_radius_mm, &gear.circular_spline.root_radius_mm})
    *radius += 0.1;
  GearEvaluator evaluator(gear, u0_design(), {{.torque_nm = {7.0}, .rotation_rad = {}}},
                          {.disk_cache = false});
  const Evaluation e = evaluator.evaluate(std::vector{0.2});
  ASSERT_TRUE(e.ok) << e.message;
  EXPECT_GT(value(e, "peak_force_n"), 0.0);
}

TEST(GearEvaluator, TakesTheWorstOfSeveralLoads) {
  GearEvaluator low = make({{.torque_nm = {1.0}, .rotation_rad = {}}});
  GearEvaluator high = make({{.torque_nm = {7.0}, .rotation_rad = {}}});
  GearEvaluator both =
      make({{.torque_nm = {1.0}, .rotation_rad = {}}, {.torque_nm = {7.0}, .rotation_rad = {}}});
  const std::vector x{0.2};
  const Evaluation a = low.evaluate(x), b = high.evaluate(x), c = both.evaluate(x);
  EXPECT_EQ(value(c, "peak_force_n"), value(b, "peak_force_n"));
  EXPECT_EQ(value(c, "engaged_count"), value(a, "engaged_count"));
  EXPECT_EQ(value(c, "tangent_stiffness_nm_per_rad"),
            std::min(value(a, "tangent_stiffness_nm_per_rad"), value(b, "tangent_stiffness_nm_per_rad")));
}

TEST(GearEvaluator, ADesignWithoutResultIsAFailedEvaluationWithItsSentence) {
  Gear gear = coarse_gear();
  const DesignSpace eccentricity({{.path = NumberPath("wave_generator.eccentricity_mm"),
                                   .lower = 0.3,
                                   .upper = 1.5,
                                   .start = 0.6,
                                   .links = {}}});
  GearEvaluator evaluator(gear, eccentricity, {{.torque_nm = {7.0}, .rotation_rad = {}}},
                          {.disk_cache = false});
  const Evaluation e = evaluator.evaluate(std::vector{0.31}); // e/u0 = 1.55: no wrap below 2.752
  EXPECT_FALSE(e.ok);
  EXPECT_EQ(e.status, "no_wrap");
  EXPECT_FALSE(e.message.empty());
  EXPECT_TRUE(e.values.empty());
}

TEST(GearEvaluator, ValuesDoNotDependOnWhatWasAskedBefore) {
  GearEvaluator used = make({{.torque_nm = {7.0}, .rotation_rad = {}, .phases = 2}});
  (void)used.evaluate(std::vector{0.195});
  (void)used.evaluate(std::vector{0.205});
  GearEvaluator fresh = make({{.torque_nm = {7.0}, .rotation_rad = {}, .phases = 2}});
  const Evaluation a = used.evaluate(std::vector{0.2}), b = fresh.evaluate(std::vector{0.2});
  EXPECT_EQ(a.values, b.values);
}

TEST(Responses, WhatALoadCannotGiveIsSaidWithTheRemedy) {
  const std::vector<Load> one_phase{{.torque_nm = {7.0}, .rotation_rad = {}}};
  const std::vector<Load> four_phases{{.torque_nm = {7.0}, .rotation_rad = {}, .phases = 4}};
  EXPECT_TRUE(find_unavailable_response("transmission_error_arcsec", seed_gear(), one_phase));
  EXPECT_FALSE(find_unavailable_response("transmission_error_arcsec", seed_gear(), four_phases));
  Gear linear = seed_gear();
  linear.contact.fidelity = Fidelity::linear;
  EXPECT_TRUE(find_unavailable_response("disc_force_n", linear, one_phase));
  EXPECT_FALSE(find_unavailable_response("peak_force_n", linear, one_phase));
}

} // namespace
} // namespace strainwave
