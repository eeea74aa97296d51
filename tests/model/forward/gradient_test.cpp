// Derivatives of forward results against central differences of whole analyses: their error has to fall with
// the square of the step, down to the rounding of an analysis.

#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/forward/gradient.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "tests/model/kinematics/order_of_convergence.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <stdexcept>

namespace strainwave::testing_support {
namespace {

const std::string fs = "flank_modification.flexspline.", cs = "flank_modification.circular_spline.";
const std::string u0 = "wave_generator.max_radial_deformation_mm";

/// Away from kinks: relief that starts between the levels at which the compliance is known.
Gear smooth_gear() {
  Gear gear = seed_gear();
  gear.mesh = {.per_pitch = 3,
               .along_face = 4,
               .along_wall = 4,
               .diaphragm = 2,
               .tooth_height = 2,
               .through_thickness = 1};
  FlankModification& m = gear.flank_modification.flexspline;
  m.tip_relief_um = 2.0;
  m.tip_relief_start = 0.62;
  m.root_relief_um = 1.0;
  m.root_relief_start = 0.4;
  m.crowning_um = 0.5;
  gear.load.torque_nm = {7.0};
  return gear;
}

/// A number of the result and its derivative by parameter.
struct Number {
  std::string name;
  double value;
  double slope;
  double noise; ///< rounding of one value
};

/// The result's numbers; slopes of parameter j where a gradient is given. `peak`: the tooth (line) and phase
/// to watch.
std::vector<Number> numbers(const ForwardResult& r, const ForwardGradient* g, Eigen::Index j,
                            std::vector<std::pair<std::size_t, std::size_t>>& peak) {
  std::vector<Number> list;
  const auto add = [&](std::string name, double value, auto&& slope, double noise) {
    list.push_back({std::move(name), value, g ? slope() : 0.0, noise});
  };
  const bool choose = peak.empty();
  for (std::size_t c = 0; c < r.load.size(); ++c) {
    const auto& phases = r.load[c].phases;
    if (choose) {
      peak.emplace_back(0, 0);
      for (std::size_t p = 0; p < phases.size(); ++p)
        for (std::size_t i = 0; i < phases[p].force_n.size(); ++i)
          if (phases[p].force_n[i] > phases[peak[c].first].force_n[peak[c].second])
            peak[c] = {p, i};
    }
    const auto [phase, tooth] = peak[c];
    const auto of = [&, phase = phase, c]() -> const ForwardGradient::Phase& { return g->load[c][phase]; };
    const auto line = static_cast<Eigen::Index>(tooth);
    add(
        "peak force", phases[phase].force_n[tooth], [&] { return of().force_n(line, j); }, 2e-7);
    add(
        "rotation", phases[phase].rotation_rad, [&] { return of().rotation_rad(j); }, 5e-13);
    if (r.load[c].peak_phase == phases[phase].phase) {
      add(
          "tangent", r.load[c].tangent_stiffness_nm_per_rad, [&] { return of().tangent_nm_per_rad(j); },
          5e-6);
      add(
          "torque", r.load[c].torque_nm, [&] { return of().torque_nm(j); }, 1e-9);
      add(
          "disc force", r.load[c].disc_force_n, [&] { return of().disc_force_n(j); }, 1e-7);
    }
  }
  add(
      "least backlash", r.backlash->assembled ? r.backlash->assembled->min_um : r.backlash->min_um,
      [&] { return g->min_backlash_um(j); }, 1e-11);
  add(
      "assembly force", r.assembly->contact_force_n, [&] { return g->assembly_force_n(j); }, 1e-8);
  if (r.stiffness) {
    add(
        "take-up", r.stiffness->take_up_rad, [&] { return g->take_up_rad(j); }, 1e-15);
    add(
        "wind-up", r.stiffness->wind_up_rad, [&] { return g->rated_rotation_rad(j) - g->take_up_rad(j); },
        5e-13);
    add(
        "rotation at 4 %", r.stiffness->lost_motion_arcmin,
        [&] { return 2.0 * g->small_rotation_rad(j) * 60.0 * 180.0 / M_PI; }, 1e-9);
  }
  return list;
}

double step_of(const std::string& path) {
  if (path.ends_with("_um") || path.find("spline_um") != std::string::npos)
    return 4e-2;
  if (path.ends_with("start") || path.ends_with("power"))
    return 2e-3;
  return path.ends_with("_deg") ? 1e-2 : 2e-5;
}

void expect_order(const Gear& gear, const std::vector<std::string>& paths) {
  ForwardModel model;
  std::shared_ptr<const ForwardSolution> solution;
  const ForwardResult base = model.analyze(gear, solution);
  ASSERT_EQ(base.status, Status::ok) << base.message;
  const ForwardGradient gradient = solution->gradient(paths);
  for (std::size_t j = 0; j < paths.size(); ++j) {
    std::vector<std::pair<std::size_t, std::size_t>> peak;
    const auto exact = numbers(base, &gradient, static_cast<Eigen::Index>(j), peak);
    const NumberPath number(paths[j]);
    std::map<double, std::vector<Number>> moved;
    const auto at = [&](double x) -> const std::vector<Number>& {
      const auto [found, fresh] = moved.try_emplace(x);
      if (fresh) {
        Gear changed = gear;
        number.set(changed, number.get(gear) + x);
        found->second = numbers(model.analyze(changed), nullptr, 0, peak);
      }
      return found->second;
    };
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const OrderReport report = order_of_convergence([&](double x) { return at(x)[k].value; },
                                                      exact[k].slope, step_of(paths[j]), exact[k].noise);
      EXPECT_TRUE(report.good) << exact[k].name << " by " << paths[j] << ": " << report.text;
    }
  }
}

const std::vector<std::string> flank_keys = {
    fs + "tip_relief_um", fs + "tip_relief_start", fs + "tip_relief_power",        fs + "root_relief_um",
    fs + "crowning_um",   cs + "tip_relief_um",    "circular_spline.profile_shift"};

TEST(Gradient, OfOnePointPerToothLinearConvergesWithOrderTwo) {
  Gear gear = smooth_gear();
  gear.contact.fidelity = Fidelity::linear;
  gear.flank_modification.circular_spline.tip_relief_um = 1.0;
  auto paths = flank_keys;
  paths.insert(paths.end(), {u0, "wave_generator.eccentricity_mm"});
  expect_order(gear, paths);
}

TEST(Gradient, OfOnePointPerToothUnilateralConvergesWithOrderTwo) {
  Gear gear = smooth_gear();
  gear.flank_modification.circular_spline.tip_relief_um = 1.0;
  gear.wave_generator.disc_taper_um = 3.0;
  auto paths = flank_keys;
  paths.insert(paths.end(), {u0, "wave_generator.eccentricity_mm", "wave_generator.disc_taper_um"});
  expect_order(gear, paths);
}

TEST(Gradient, OfNormalForcesAtSeveralPhasesLoadsAndDirectionsConvergesWithOrderTwo) {
  Gear gear = smooth_gear();
  gear.contact.force_direction = ForceDirection::flank_normal;
  gear.load = {.torque_nm = {3.5, 7.0}, .rotation_rad = {2e-3}, .direction = Direction::both, .phases = 2};
  expect_order(gear, {fs + "crowning_um", u0});
}

TEST(Gradient, OfTheWholeFlankKinematicConvergesWithOrderTwo) {
  Gear gear = smooth_gear();
  gear.contact.flank_points = 5;
  gear.contact.face_slices = 3;
  gear.flank_modification.flexspline.lead_taper_um = 2.0;
  gear.flank_modification.flexspline.lead_crowning_um = 2.0;
  gear.flank_modification.flexspline.spline_um = {0.3, 0.1, 0.2, 0.4};
  expect_order(
      gear, {fs + "lead_taper_um", fs + "lead_crowning_um", fs + "tip_relief_um", fs + "spline_um[2]", u0});
}

TEST(Gradient, OfTheWholeFlankLinearConvergesWithOrderTwo) {
  Gear gear = smooth_gear();
  gear.contact.fidelity = Fidelity::linear;
  gear.contact.flank_points = 5;
  expect_order(gear, {fs + "crowning_um", fs + "tip_relief_um", u0});
}

TEST(Gradient, OfTheConedAssembledCupConvergesWithOrderTwo) {
  for (const Fidelity fidelity : {Fidelity::linear, Fidelity::unilateral}) {
    Gear gear = smooth_gear();
    gear.contact.fidelity = fidelity;
    gear.contact.gaps = GapModel::assembled;
    gear.contact.flank_points = 5;
    gear.contact.face_slices = 3;
    gear.circular_spline.profile_shift = 2.3; // free of interference at the front of the face
    gear.flank_modification.flexspline.lead_taper_um = 2.0;
    gear.flank_modification.flexspline.lead_crowning_um = 2.0;
    expect_order(gear, {fs + "lead_taper_um", fs + "lead_crowning_um", fs + "tip_relief_um", u0,
                        "wave_generator.eccentricity_mm", "wave_generator.disc_taper_um"});
  }
}

TEST(Gradient, OfAWedgedGearWithForcesOnBothFlanksConvergesWithOrderTwo) {
  Gear gear = smooth_gear();
  gear.contact.gaps = GapModel::assembled;
  gear.contact.force_direction = ForceDirection::flank_normal;
  gear.contact.flank_points = 5;
  gear.contact.face_slices = 3;
  gear.flank_modification.flexspline.lead_taper_um = 2.0;
  gear.circular_spline.profile_shift = 2.1; // interferes at the front of the face
  gear.load.torque_nm = {0.5};
  const ForwardResult wedged = ForwardModel().analyze(gear);
  ASSERT_EQ(wedged.status, Status::ok) << wedged.message;
  ASSERT_GT(wedged.load.front().coast.peak_force_n, 0.1);
  expect_order(gear, {fs + "lead_taper_um", fs + "crowning_um", "circular_spline.profile_shift", u0});
}

TEST(Gradient, FollowsTheShiftOfTheDiscsToTheReferenceSection) {
  Gear gear = smooth_gear();
  gear.contact.gaps = GapModel::assembled;
  gear.contact.reference_section_mm = 24.5;
  gear.circular_spline.profile_shift = 2.3;
  expect_order(gear, {u0, "wave_generator.disc_taper_um"});
}

TEST(Gradient, OfOtherWaveGeneratorsConvergesWithOrderTwo) {
  Gear gear = smooth_gear();
  gear.wave_generator.shape = WaveGeneratorShape::ellipse;
  gear.wave_generator.eccentricity_mm.reset();
  expect_order(gear, {fs + "crowning_um", u0});
  gear.wave_generator.shape = WaveGeneratorShape::two_disc;
  gear.wave_generator.wrap_angle_deg = 50.0;
  expect_order(gear, {u0, "wave_generator.wrap_angle_deg"});
  gear.wave_generator.wrap_angle_deg.reset();
  gear.wave_generator.eccentricity_mm = 0.6;
  gear.contact.disc_gap = DiscGap::linearised;
  expect_order(gear, {u0, "wave_generator.eccentricity_mm"});
}

TEST(Gradient, AnalysisThatKeepsItsSolutionGivesTheSameNumbers) {
  for (const int points : {1, 5}) {
    Gear gear = smooth_gear();
    gear.contact.flank_points = points;
    gear.contact.gaps = points == 1 ? GapModel::kinematic : GapModel::assembled;
    gear.circular_spline.profile_shift = 2.3;
    gear.load = {.torque_nm = {3.5, 7.0}, .rotation_rad = {2e-3}, .direction = Direction::both, .phases = 3};
    std::shared_ptr<const ForwardSolution> solution;
    const ForwardResult lean = ForwardModel().analyze(gear, solution), full = ForwardModel().analyze(gear);
    ASSERT_EQ(lean.status, Status::ok) << lean.message;
    ASSERT_EQ(lean.load.size(), full.load.size());
    const auto same = [](double a, double b) { EXPECT_NEAR(a, b, 1e-12 * std::abs(b)); };
    for (std::size_t c = 0; c < full.load.size(); ++c) {
      ASSERT_EQ(lean.load[c].force_n.size(), full.load[c].force_n.size());
      for (std::size_t i = 0; i < full.load[c].force_n.size(); ++i)
        same(lean.load[c].force_n[i], full.load[c].force_n[i]);
      for (std::size_t p = 0; p < full.load[c].phases.size(); ++p)
        same(lean.load[c].phases[p].rotation_rad, full.load[c].phases[p].rotation_rad);
      same(lean.load[c].tangent_stiffness_nm_per_rad, full.load[c].tangent_stiffness_nm_per_rad);
      same(lean.load[c].disc_force_n, full.load[c].disc_force_n);
    }
    same(lean.backlash->min_um, full.backlash->min_um);
    same(lean.assembly->contact_force_n, full.assembly->contact_force_n);
    same(lean.stiffness->secant_nm_per_rad, full.stiffness->secant_nm_per_rad);
    same(lean.stiffness->lost_motion_arcmin, full.stiffness->lost_motion_arcmin);
  }
}

TEST(Gradient, RefusesKeysThatActThroughTheFiniteElements) {
  const Gear gear = seed_gear();
  for (const char* path :
       {"flexspline.wall_thickness_mm", "flexspline.profile_shift", "wave_generator.contact_width_mm",
        "material.youngs_modulus_mpa", "wave_generator.wrap_angle_deg"})
    EXPECT_FALSE(has_exact_gradient(gear, path)) << path;
  ForwardModel model;
  std::shared_ptr<const ForwardSolution> solution;
  ASSERT_EQ(model.analyze(gear, solution).status, Status::ok);
  const std::vector<std::string> wall = {"flexspline.wall_thickness_mm"};
  EXPECT_THROW((void)solution->gradient(wall), std::invalid_argument);
}

} // namespace
} // namespace strainwave::testing_support
