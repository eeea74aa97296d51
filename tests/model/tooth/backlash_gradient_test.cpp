// Every derivative of backlash and contact radius against central differences: the error must fall with the
// square of the step.

#include "strainwave/model/tooth/backlash_gradient.hpp"
#include "tests/model/kinematics/order_of_convergence.hpp"
#include "tests/model/tooth/curve_of.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

namespace strainwave::testing_support {
namespace {

/// The key behind a path, and a step at which truncation is above rounding but the contact stays where it is.
struct Key {
  std::function<double&(Gear&)> in;
  double step;
};

double& in_modification(FlankModification& m, const std::string& key) {
  const std::map<std::string, double*> keys{{"tip_relief_um", &m.tip_relief_um},
                                            {"tip_relief_start", &m.tip_relief_start},
                                            {"tip_relief_power", &m.tip_relief_power},
                                            {"root_relief_um", &m.root_relief_um},
                                            {"root_relief_start", &m.root_relief_start},
                                            {"crowning_um", &m.crowning_um},
                                            {"slope_um", &m.slope_um},
                                            {"lead_crowning_um", &m.lead_crowning_um},
                                            {"lead_taper_um", &m.lead_taper_um},
                                            {"end_relief_um", &m.end_relief_um},
                                            {"end_relief_length_mm", &m.end_relief_length_mm}};
  if (key.starts_with("spline_um["))
    return m.spline_um[static_cast<std::size_t>(std::stoi(key.substr(10)))];
  return *keys.at(key);
}

Key key_of(const std::string& path) {
  const std::map<std::string, Key> plain{
      {"flexspline.module_mm", {[](Gear& g) -> double& { return g.flexspline.module_mm; }, 1e-5}},
      {"flexspline.pressure_angle_deg",
       {[](Gear& g) -> double& { return g.flexspline.pressure_angle_deg; }, 2e-2}},
      {"flexspline.profile_shift", {[](Gear& g) -> double& { return g.flexspline.profile_shift; }, 2e-3}},
      {"flexspline.tip_radius_mm", {[](Gear& g) -> double& { return g.flexspline.tip_radius_mm; }, 1e-3}},
      {"flexspline.root_radius_mm", {[](Gear& g) -> double& { return g.flexspline.root_radius_mm; }, 1e-3}},
      {"flexspline.neutral_radius_mm",
       {[](Gear& g) -> double& { return g.flexspline.neutral_radius_mm; }, 1e-2}},
      {"flexspline.face_width_mm", {[](Gear& g) -> double& { return g.flexspline.face_width_mm; }, 1e-2}},
      {"circular_spline.profile_shift",
       {[](Gear& g) -> double& { return g.circular_spline.profile_shift; }, 2e-3}},
      {"circular_spline.tip_radius_mm",
       {[](Gear& g) -> double& { return g.circular_spline.tip_radius_mm; }, 1e-3}},
      {"circular_spline.root_radius_mm",
       {[](Gear& g) -> double& { return g.circular_spline.root_radius_mm; }, 1e-3}},
      {"wave_generator.max_radial_deformation_mm",
       {[](Gear& g) -> double& { return g.wave_generator.max_radial_deformation_mm; }, 1e-4}},
      {"wave_generator.eccentricity_mm",
       {[](Gear& g) -> double& { return *g.wave_generator.eccentricity_mm; }, 2e-4}},
      {"wave_generator.wrap_angle_deg",
       {[](Gear& g) -> double& { return *g.wave_generator.wrap_angle_deg; }, 2e-2}},
      {"wave_generator.force_angle_deg",
       {[](Gear& g) -> double& { return *g.wave_generator.force_angle_deg; }, 2e-2}}};
  if (plain.contains(path))
    return plain.at(path);
  const bool tooth = path.starts_with("flank_modification.flexspline.");
  const std::string key = path.substr(path.rfind('.') + 1);
  return {[tooth, key](Gear& g) -> double& {
            return in_modification(
                tooth ? g.flank_modification.flexspline : g.flank_modification.circular_spline, key);
          },
          key.ends_with("start") || key.ends_with("power") ? 4e-3
          : key.ends_with("_mm")                           ? 1e-2
                                                           : 2e-2};
}

bool same_place(const ToothBacklash& a, const ToothBacklash& b) {
  return a.overlap == b.overlap && a.place == b.place && a.kink == b.kink;
}

/// Checks all parameters on some teeth; returns how many entries were compared.
int expect_order(const Gear& gear, double phase, double zeta) {
  const NeutralCurve curve = curve_of(gear);
  const auto at = backlash(gear, curve, phase, zeta);
  EXPECT_TRUE(at.ok()) << at.failure().message;
  const std::vector<std::string> paths = backlash_parameters(gear, curve);
  const BacklashGradient gradient = backlash_gradient(gear, curve, *at, paths);
  EXPECT_EQ(gradient.parameters, paths.size());
  int compared = 0;
  for (std::size_t j = 0; j < paths.size(); ++j) {
    // At the smallest power allowed there is only one side to move to.
    if (paths[j].ends_with("tip_relief_power") && gear.flank_modification.flexspline.tip_relief_power == 1.0)
      continue;
    const Key key = key_of(paths[j]);
    std::map<double, Backlash> moved;
    const auto result = [&](double x) -> const Backlash& {
      if (const auto found = moved.find(x); found != moved.end())
        return found->second;
      Gear changed = gear;
      key.in(changed) += x;
      return moved.emplace(x, backlash(changed, curve_of(changed), phase, zeta).value()).first->second;
    };
    for (std::size_t k = 0; k < at->tooth.size(); ++k)
      for (const bool drive : {true, false}) {
        const auto of = [&](const Backlash& b) -> const ToothBacklash& {
          return drive ? b.drive[k] : b.coast[k];
        };
        // At a change of place within the step the function has a kink, and no derivative to compare with.
        if (!of(*at).overlap || !same_place(of(result(key.step)), of(*at)) ||
            !same_place(of(result(-key.step)), of(*at)))
          continue;
        const std::size_t entry = k * paths.size() + j;
        const auto gap =
            order_of_convergence([&](double x) { return of(result(x)).backlash_mm; },
                                 (drive ? gradient.drive_mm : gradient.coast_mm)[entry], key.step, 2e-14);
        const auto radius = order_of_convergence(
            [&](double x) { return of(result(x)).contact_radius_mm; },
            (drive ? gradient.drive_radius_mm : gradient.coast_radius_mm)[entry], key.step, 2e-13);
        EXPECT_TRUE(gap.good) << paths[j] << (drive ? " drive" : " coast") << " backlash, tooth "
                              << at->tooth[k] << ": " << gap.text;
        EXPECT_TRUE(radius.good) << paths[j] << (drive ? " drive" : " coast") << " radius, tooth "
                                 << at->tooth[k] << ": " << radius.text;
        ++compared;
      }
  }
  return compared;
}

Gear seed(WaveGeneratorShape shape) {
  Gear gear = seed_gear();
  gear.wave_generator.shape = shape;
  gear.contact.window_deg = {-20.0, 50.0};
  // Away from zero, where slope and taper have one-sided derivatives and reliefs end.
  for (FlankModification* m :
       {&gear.flank_modification.flexspline, &gear.flank_modification.circular_spline}) {
    m->slope_um = 0.5;
    m->lead_taper_um = 0.5;
    m->lead_crowning_um = 0.5;
    m->end_relief_um = 1.0;
    m->end_relief_length_mm = 1.5;
    m->tip_relief_um = 0.4;
    m->root_relief_um = 0.3;
    m->root_relief_start = 0.35; // its kink must not lie on that of the tip relief
    m->crowning_um = 0.2;
  }
  return gear;
}

TEST(BacklashGradient, ConvergesWithSecondOrderOnFirstOrderDiscs) {
  EXPECT_GT(expect_order(seed(WaveGeneratorShape::two_disc), 0.0, 0.0), 1000);
}

TEST(BacklashGradient, ConvergesWithSecondOrderOnExactDiscsAwayFromMidFace) {
  EXPECT_GT(expect_order(seed(WaveGeneratorShape::two_disc_exact), 0.3, 0.7), 1000);
}

TEST(BacklashGradient, ConvergesWithSecondOrderForContactInsideTheFlank) {
  Gear gear = seed(WaveGeneratorShape::two_disc_exact);
  gear.wave_generator.eccentricity_mm.reset();
  gear.wave_generator.wrap_angle_deg = 48.0;
  gear.flank_modification.flexspline.tip_relief_um = 9.0;
  gear.flank_modification.flexspline.tip_relief_power = 2.5;
  gear.flank_modification.flexspline.slope_um = -2.0;
  gear.flank_modification.flexspline.spline_um = {4.0, 1.0, 2.0, 5.0};
  gear.flank_modification.circular_spline.spline_um = {6.0, 1.0, 3.0};
  EXPECT_GT(expect_order(gear, 0.6, -0.4), 1000);
}

TEST(BacklashGradient, ConvergesWithSecondOrderForContactAtKinks) {
  Gear gear = seed(WaveGeneratorShape::four_force);
  gear.wave_generator.force_angle_deg = 30.0;
  gear.flank_modification.flexspline.tip_relief_um = 15.0;
  gear.flank_modification.flexspline.tip_relief_power = 1.0;
  gear.flank_modification.circular_spline.tip_relief_um = 15.0;
  gear.flank_modification.circular_spline.tip_relief_power = 1.0;
  gear.flank_modification.circular_spline.tip_relief_start = 0.6;
  EXPECT_GT(expect_order(gear, 0.1, 0.2), 500);
  const auto at = backlash(gear, curve_of(gear), 0.1, 0.2);
  const auto kinks = std::count_if(at->drive.begin(), at->drive.end(), [](const ToothBacklash& b) {
    return b.place == ContactPlace::flexspline_kink || b.place == ContactPlace::circular_spline_kink;
  });
  EXPECT_GT(kinks, 3);
}

TEST(BacklashGradient, ConvergesWithSecondOrderForOddToothNumbers) {
  Gear gear = seed(WaveGeneratorShape::ellipse);
  gear.flexspline.teeth = 141;
  gear.circular_spline.teeth = 143;
  gear.flexspline.module_mm = 28.0 / 141.0;
  EXPECT_GT(expect_order(gear, 0.0, 0.0), 1000);
}

TEST(BacklashGradient, AnySubsetInAnyOrderGivesTheSameNumbers) {
  const Gear gear = seed(WaveGeneratorShape::two_disc);
  const NeutralCurve curve = curve_of(gear);
  const auto at = backlash(gear, curve);
  const std::vector<std::string> all = backlash_parameters(gear, curve);
  const BacklashGradient whole = backlash_gradient(gear, curve, *at, all);
  const std::vector<std::string> some{all[20], all[3], all[0]};
  const BacklashGradient part = backlash_gradient(gear, curve, *at, some);
  for (std::size_t k = 0; k < at->tooth.size(); ++k)
    for (const auto& [column, from] : {std::pair<std::size_t, std::size_t>{0, 20}, {1, 3}, {2, 0}})
      EXPECT_NEAR(part.drive_mm[k * 3 + column], whole.drive_mm[k * all.size() + from], 1e-12);
}

TEST(BacklashGradient, UnmodifiedGearHasOneSidedDerivativesOfTheModification) {
  Gear gear = seed_gear();
  const NeutralCurve curve = curve_of(gear);
  const auto at = backlash(gear, curve);
  const std::vector<std::string> path{"flank_modification.flexspline.slope_um"};
  const BacklashGradient gradient = backlash_gradient(gear, curve, *at, path);
  gear.flank_modification.flexspline.slope_um = 1e-3;
  const auto moved = backlash(gear, curve);
  for (std::size_t k = 0; k < at->tooth.size(); ++k)
    if (at->drive[k].overlap) {
      EXPECT_NEAR((moved->drive[k].backlash_mm - at->drive[k].backlash_mm) / 1e-3, gradient.drive_mm[k],
                  1e-8);
    }
}

TEST(BacklashGradient, UnknownPathIsNamed) {
  const Gear gear = seed(WaveGeneratorShape::two_disc);
  const NeutralCurve curve = curve_of(gear);
  const auto at = backlash(gear, curve);
  for (const std::string path :
       {"flexspline.teeth", "wave_generator.wrap_angle_deg", "flank_modification.flexspline.spline_um[0]"}) {
    try {
      (void)backlash_gradient(gear, curve, *at, std::vector<std::string>{path});
      ADD_FAILURE() << path;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
    }
  }
}

} // namespace
} // namespace strainwave::testing_support
