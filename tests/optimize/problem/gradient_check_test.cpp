// The checker of derivatives on functions whose derivatives are known, with one entry falsified, and at
// kinks; and on the seed gear.

#include "strainwave/optimize/gear/gear_evaluator.hpp"
#include "strainwave/optimize/problem/gradient_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strainwave::testing_support {
namespace {

/// Two responses and two pieces of two variables, all smooth but the last response, |x₀ − ¼|.
struct Smooth : Evaluator {
  std::span<const Response> responses() const override { return list; }
  Evaluation evaluate(std::span<const double> x) override {
    Evaluation e;
    e.ok = true;
    e.values = {std::exp(x[0]) * x[1], std::sin(3.0 * x[0] + x[1]), std::abs(x[0] - 0.25)};
    e.pieces = {x[0] * x[0] * x[1], std::exp(x[0]) * x[1]};
    return e;
  }
  std::vector<double> gradient(std::span<const double> x) override {
    const double c = std::cos(3.0 * x[0] + x[1]);
    std::vector<double> g = {
        std::exp(x[0]) * x[1], std::exp(x[0]), 3.0 * c, c, x[0] >= 0.25 ? 1.0 : -1.0, 0.0};
    if (poisoned)
      g[*poisoned] *= 1.0 + share;
    return g;
  }
  std::optional<std::size_t> pieces_of() const override { return 0; }
  std::vector<double> piece_gradient(std::span<const double> x) override {
    return {2.0 * x[0] * x[1], x[0] * x[0] * (poison_piece ? 0.99 : 1.0), std::exp(x[0]) * x[1],
            std::exp(x[0])};
  }
  std::vector<Response> list = {{"growth", "", ""}, {"wave", "", ""}, {"bend", "", ""}};
  std::optional<std::size_t> poisoned;
  double share = 1e-3;
  bool poison_piece = false;
};

DesignSpace square() {
  std::vector<DesignVariable> variables;
  for (const char* path :
       {"flank_modification.flexspline.tip_relief_um", "flank_modification.flexspline.root_relief_um"})
    variables.push_back({.path = NumberPath(path), .lower = 0.0, .upper = 1.0, .start = 0.5, .links = {}});
  return DesignSpace(std::move(variables));
}

TEST(GradientCheck, FindsNothingWrongWithRightDerivatives) {
  Smooth smooth;
  const GradientCheck check = check_gradient(smooth, square(), std::vector{0.4, 0.6});
  ASSERT_TRUE(check.ok);
  EXPECT_EQ(check.wrong, 0u);
  EXPECT_EQ(check.slopes.size(), 8u); // three responses and the worst piece, for each variable
  for (const SlopeCheck& slope : check.slopes)
    EXPECT_EQ(slope.verdict, SlopeVerdict::right) << slope.response;
}

TEST(GradientCheck, NamesTheOneEntryThatIsPoisoned) {
  for (std::size_t entry = 0; entry < 5; ++entry) { // the last one is zero and stays so
    Smooth smooth;
    smooth.poisoned = entry;
    const GradientCheck check = check_gradient(smooth, square(), std::vector{0.4, 0.6});
    EXPECT_EQ(check.wrong, 1u);
    EXPECT_EQ(check.slopes.front().verdict, SlopeVerdict::wrong);
    EXPECT_EQ(check.slopes.front().response, smooth.list[entry / 2].name);
    EXPECT_EQ(check.slopes.front().variable, entry % 2);
    EXPECT_NEAR(check.slopes.front().least_error, smooth.share, 0.1 * smooth.share);
  }
}

TEST(GradientCheck, NamesAPoisonedPiece) {
  Smooth smooth;
  smooth.poison_piece = true;
  const GradientCheck check = check_gradient(smooth, square(), std::vector{0.4, 0.6});
  EXPECT_EQ(check.wrong, 1u);
  EXPECT_EQ(check.slopes.front().response, "piece 0 of growth");
  EXPECT_EQ(check.slopes.front().variable, 1u);
}

TEST(GradientCheck, GivesBothOneSidedSlopesAtAKink) {
  Smooth smooth;
  const GradientCheck check = check_gradient(smooth, square(), std::vector{0.25, 0.6});
  EXPECT_EQ(check.wrong, 0u);
  const SlopeCheck& kink = check.slopes.front();
  EXPECT_EQ(kink.verdict, SlopeVerdict::kink);
  EXPECT_EQ(kink.response, "bend");
  EXPECT_NEAR(kink.left, -1.0, 1e-9);
  EXPECT_NEAR(kink.right, 1.0, 1e-9);
}

TEST(GradientCheck, TakesAOneSidedFormulaOfTheSameOrderAtABound) {
  Smooth smooth;
  for (const double corner : {0.0, 1.0})
    EXPECT_EQ(check_gradient(smooth, square(), std::vector{corner, corner}).wrong, 0u);
  smooth.poisoned = 2;
  EXPECT_EQ(check_gradient(smooth, square(), std::vector{1.0, 0.0}).slopes.front().response, "wave");
}

TEST(GradientCheck, SaysSoWhenThereIsNoGradient) {
  struct Without : Smooth {
    std::vector<double> gradient(std::span<const double>) override { return {}; }
  } without;
  const GradientCheck check = check_gradient(without, square(), std::vector{0.4, 0.6});
  EXPECT_FALSE(check.ok);
  EXPECT_EQ(check.message, "the evaluator states no gradient");
}

Gear coarse_seed() {
  Gear gear = seed_gear();
  gear.mesh = {.per_pitch = 3,
               .along_face = 2,
               .along_wall = 2,
               .diaphragm = 1,
               .tooth_height = 2,
               .through_thickness = 1};
  return gear;
}

DesignVariable variable(const char* path, double lower, double upper, double start) {
  return {.path = NumberPath(path), .lower = lower, .upper = upper, .start = start, .links = {}};
}

TEST(GradientCheck, AgreesWithAllResponsesOfTheSeedGearWithLinksAndSeveralLoads) {
  DesignVariable u0 = variable("wave_generator.max_radial_deformation_mm", 0.19, 0.21, 0.1987);
  u0.links = {{NumberPath("wave_generator.eccentricity_mm"), 3.0}};
  const DesignSpace design({variable("flank_modification.flexspline.tip_relief_um", 0.0, 8.0, 2.3),
                            variable("flank_modification.flexspline.crowning_um", 0.0, 4.0, 1.1), u0});
  const Load loads[] = {{.torque_nm = {3.5, 7.0}, .rotation_rad = {}, .phases = 2},
                        {.torque_nm = {7.0}, .rotation_rad = {}, .direction = Direction::coast, .phases = 1}};
  GearEvaluator evaluator(coarse_seed(), design, {loads[0], loads[1]});
  const GradientCheck check = check_gradient(evaluator, design, design.start());
  ASSERT_TRUE(check.ok) << check.message;
  for (const SlopeCheck& slope : check.slopes)
    EXPECT_EQ(slope.verdict,
              slope.response == "edge_backlash_um" ? SlopeVerdict::unknown : SlopeVerdict::right)
        << slope.response << " by " << design.variables()[slope.variable].path.path() << ": " << slope.exact
        << " against " << slope.difference;
}

TEST(GradientCheck, AgreesOverTheWholeFlankWithForcesAlongItsNormal) {
  // Loaded tip edges beside loaded flanks, knots of the free form on the heights, slices with flanks of their
  // own.
  for (const GapModel gaps : {GapModel::kinematic, GapModel::assembled}) {
    Gear gear = coarse_seed();
    gear.contact.flank_points = 5;
    gear.contact.face_slices = 3;
    gear.contact.gaps = gaps;
    gear.contact.force_direction = ForceDirection::flank_normal;
    gear.flank_modification.flexspline.spline_um = {1.3, 1.2, 1.8, 2.1, 2.4};
    if (gaps == GapModel::assembled)
      gear.circular_spline.profile_shift = 2.42;
    const double x2 = gear.circular_spline.profile_shift;
    const DesignSpace design({variable("flank_modification.flexspline.spline_um[3]", 0.0, 8.0, 2.1),
                              variable("flank_modification.flexspline.lead_taper_um", -8.0, 8.0, 3.1),
                              variable("flank_modification.flexspline.lead_crowning_um", 0.0, 8.0, 1.3),
                              variable("circular_spline.profile_shift", x2 - 0.1, x2 + 0.1, x2),
                              variable("wave_generator.max_radial_deformation_mm", 0.19, 0.21, 0.2)});
    GearEvaluator evaluator(gear, design, {{.torque_nm = {7.0}, .rotation_rad = {}, .phases = 2}});
    const GradientCheck check = check_gradient(evaluator, design, design.start());
    ASSERT_TRUE(check.ok) << check.message;
    EXPECT_EQ(check.wrong, 0u);
    for (const SlopeCheck& slope : check.slopes)
      EXPECT_NE(slope.verdict, SlopeVerdict::wrong)
          << slope.response << " by " << design.variables()[slope.variable].path.path() << ": " << slope.exact
          << " against " << slope.difference;
  }
}

TEST(GearEvaluatorGradient, OfTheLargestForceIsThatOfItsPiece) {
  const DesignSpace design({variable("flank_modification.flexspline.tip_relief_um", 0.0, 8.0, 2.3),
                            variable("circular_spline.profile_shift", 2.1, 2.3, 2.2)});
  GearEvaluator evaluator(coarse_seed(), design, {{.torque_nm = {7.0}, .rotation_rad = {}, .phases = 3}});
  const std::vector<double> x = design.start();
  const Evaluation at = evaluator.evaluate(x);
  ASSERT_TRUE(at.ok) << at.message;
  const auto peak =
      static_cast<std::size_t>(std::max_element(at.pieces.begin(), at.pieces.end()) - at.pieces.begin());
  const std::vector<double> gradient = evaluator.gradient(x), pieces = evaluator.piece_gradient(x);
  ASSERT_EQ(pieces.size(), 2 * at.pieces.size());
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(gradient[2 * *evaluator.pieces_of() + i], pieces[2 * peak + i]);
  const std::vector<double> other =
      GearEvaluator(coarse_seed(), design, {{.torque_nm = {7.0}, .rotation_rad = {}, .phases = 3}})
          .gradient(x);
  ASSERT_EQ(other.size(), gradient.size());
  for (std::size_t i = 0; i < gradient.size(); ++i) // not a number: no exact slope
    EXPECT_TRUE(other[i] == gradient[i] || (std::isnan(other[i]) && std::isnan(gradient[i]))) << i;
}

TEST(GearEvaluatorGradient, DifferencesWhatActsThroughTheFiniteElements) {
  // Wall thickness acts on the compliance alone: the least backlash does not feel it, the forces do.
  const DesignSpace design({variable("flexspline.wall_thickness_mm", 0.15, 0.35, 0.25),
                            variable("flank_modification.flexspline.tip_relief_um", 0.0, 8.0, 2.3)});
  GearEvaluator evaluator(coarse_seed(), design, {{.torque_nm = {7.0}, .rotation_rad = {}}});
  EXPECT_FALSE(evaluator.exact(0));
  EXPECT_TRUE(evaluator.exact(1));
  const std::vector<double> x = design.start();
  const std::vector<double> gradient = evaluator.gradient(x);
  const auto at = [&](const char* name) { return gradient[2 * *find_response(gear_responses(), name)]; };
  EXPECT_EQ(at("min_backlash_um"), 0.0);
  const auto rotation = [&](double wall) {
    return evaluator.evaluate(std::vector{wall, x[1]})
        .values[*find_response(gear_responses(), "rotation_rad")];
  };
  // A step half as wide; 1e-5 of the rotation over the range for rounding, a third of which each has.
  const double narrow = (rotation(0.2502) - rotation(0.2498)) / 0.0004;
  EXPECT_NEAR(at("rotation_rad"), narrow, 1e-5 * rotation(0.25) / 0.2);
}

} // namespace
} // namespace strainwave::testing_support
