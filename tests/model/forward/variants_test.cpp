// Every way a gear file can ask for: shapes, directions, phases, odd teeth, one lobe, gears without a result.

#include "strainwave/model/export/result_json.hpp"
#include "strainwave/model/forward/forward.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numeric>

namespace strainwave {
namespace {

ForwardModel& model() {
  static ForwardModel shared({.disk_cache = false});
  return shared;
}

TEST(Variants, CoastAtPhaseZeroIsTheMirrorImageOfDrive) {
  Gear gear = seed_gear();
  gear.load.direction = Direction::both;
  gear.load.torque_nm = {7.0};
  const ForwardResult result = model().analyze(gear);
  ASSERT_EQ(result.load.size(), 2U);
  const LoadResult& drive = result.load[0];
  const LoadResult& coast = result.load[1];
  EXPECT_EQ(coast.direction, Direction::coast);
  EXPECT_DOUBLE_EQ(coast.peak_force_n, drive.peak_force_n);
  EXPECT_DOUBLE_EQ(coast.peak_phi_deg, -drive.peak_phi_deg);
  EXPECT_DOUBLE_EQ(coast.engaged_lo_deg, -drive.engaged_hi_deg);
  EXPECT_TRUE(std::is_sorted(coast.phi_deg.begin(), coast.phi_deg.end()));
}

TEST(Variants, CoastAtOtherPhasesMirrorsThePhaseToo) {
  // Over the phases of one pitch drive and coast see the same set of mirrored problems, so the worst peak is
  // the same.
  Gear gear = seed_gear();
  gear.load.direction = Direction::both;
  gear.load.torque_nm = {7.0};
  gear.load.phases = 4;
  const ForwardResult result = model().analyze(gear);
  EXPECT_NEAR(result.load[1].peak_force_n, result.load[0].peak_force_n, 1e-9 * result.load[0].peak_force_n);
  EXPECT_NEAR(*result.load[1].transmission_error_arcsec, *result.load[0].transmission_error_arcsec, 1e-6);
  const LoadResult& coast = result.load[1];
  for (std::size_t i = 0; i < coast.tooth.size(); ++i) {
    EXPECT_NEAR(coast.phi_deg[i], 360.0 / 140.0 * (coast.tooth[i] + coast.peak_phase), 1e-9);
  }
}

TEST(Variants, ForcesCarryTheTorqueThatWasAskedFor) {
  const Gear gear = seed_gear();
  const ForwardResult result = model().analyze(gear);
  for (std::size_t k = 0; k < result.load.size(); ++k) {
    const LoadResult& load = result.load[k];
    double torque = 0.0;
    for (std::size_t i = 0; i < load.tooth.size(); ++i) {
      for (std::size_t j = 0; j < result.backlash->tooth.size(); ++j) {
        if (result.backlash->tooth[j] == load.tooth[i])
          torque += 2e-3 * load.force_n[i] * result.backlash->contact_radius_mm[j];
      }
    }
    EXPECT_NEAR(torque, gear.load.torque_nm[k], 1e-10 * torque);
  }
}

TEST(Variants, EveryShapeWithASurfaceAnalyses) {
  for (const WaveGeneratorShape shape :
       {WaveGeneratorShape::two_disc, WaveGeneratorShape::ellipse, WaveGeneratorShape::cosine}) {
    Gear gear = seed_gear();
    gear.wave_generator.shape = shape;
    if (shape != WaveGeneratorShape::two_disc)
      gear.wave_generator.eccentricity_mm.reset();
    gear.circular_spline.profile_shift = 2.25; // free of interference for all of them
    const ForwardResult result = model().analyze(gear);
    EXPECT_EQ(result.status, Status::ok) << static_cast<int>(shape) << ": " << result.message;
    EXPECT_GT(result.assembly->contact_force_n, 10.0);
    // every one of them is given u0 = 0.2 mm; the front of the coned cup stands further out than its rear
    // edge
    EXPECT_NEAR(result.assembly->radial_deformation_mm, 0.2, 0.03) << static_cast<int>(shape);
  }
}

TEST(Variants, CamHoldsMoreOfTheWallThanDiscsAndIsStiffer) {
  Gear gear = seed_gear();
  gear.circular_spline.profile_shift = 2.25;
  const double discs = model().analyze(gear).stiffness->secant_nm_per_rad;
  gear.wave_generator.shape = WaveGeneratorShape::ellipse;
  gear.wave_generator.eccentricity_mm.reset();
  EXPECT_GT(model().analyze(gear).stiffness->secant_nm_per_rad, discs);
}

TEST(Variants, FourForcesHoldTheWallAtFourLinesAndAreLinearOnly) {
  Gear gear = seed_gear();
  gear.wave_generator.shape = WaveGeneratorShape::four_force;
  gear.wave_generator.eccentricity_mm.reset();
  gear.wave_generator.force_angle_deg = 30.0;
  gear.circular_spline.profile_shift = 2.3;
  EXPECT_EQ(model().analyze(gear).status, Status::not_available);
  gear.contact.fidelity = Fidelity::linear;
  const ForwardResult result = model().analyze(gear);
  ASSERT_EQ(result.status, Status::ok) << result.message;
  EXPECT_GT(result.assembly->contact_force_n, 1.0);
  EXPECT_TRUE(result.certificate->holds());
}

TEST(Variants, OddNumberOfTeethTreatsBothLobesUnfolded) {
  Gear gear = seed_gear();
  gear.flexspline.teeth = 141;
  gear.circular_spline.teeth = 143;
  // the same tooth form on pitch radii 0.1 mm larger
  for (double* radius :
       {&gear.flexspline.tip_radius_mm, &gear.flexspline.root_radius_mm, &gear.flexspline.neutral_radius_mm,
        &gear.circular_spline.tip_radius_mm, &gear.circular_spline.root_radius_mm}) {
    *radius += 0.1;
  }
  gear.load.torque_nm = {7.0};
  const ForwardResult odd = model().analyze(gear);
  ASSERT_EQ(odd.status, Status::ok) << odd.message;
  const ForwardResult even = model().analyze(seed_gear());
  // nearly the same gear: stiffness within 5 %, twice as many teeth in the list
  EXPECT_NEAR(odd.stiffness->secant_nm_per_rad, even.stiffness->secant_nm_per_rad,
              0.05 * even.stiffness->secant_nm_per_rad);
  EXPECT_GT(odd.load[0].tooth.size(), 1.8 * static_cast<double>(even.load[1].tooth.size()));
  EXPECT_NEAR(odd.load[0].torque_nm, 7.0, 1e-9);
}

TEST(Variants, UnfoldedEvenRingGivesTheFoldedForces) {
  // lobes = 2 folds an even ring; the unfolded ring with both lobes loaded must agree. One lobe alone is
  // softer.
  Gear gear = seed_gear();
  gear.load.torque_nm = {3.0};
  const ForwardResult two = model().analyze(gear);
  gear.contact.lobes = 1;
  gear.load.torque_nm = {1.5};
  const ForwardResult one = model().analyze(gear);
  ASSERT_EQ(one.status, Status::ok) << one.message;
  EXPECT_GT(one.load[0].rotation_rad - one.stiffness->take_up_rad,
            two.load[0].rotation_rad - two.stiffness->take_up_rad);
}

TEST(Variants, FlankNormalForceKeepsTheTorqueAndRaisesTheForce) {
  Gear gear = seed_gear();
  gear.load.torque_nm = {7.0};
  const ForwardResult along = model().analyze(gear);
  gear.contact.force_direction = ForceDirection::flank_normal;
  const ForwardResult normal = model().analyze(gear);
  ASSERT_EQ(normal.status, Status::ok) << normal.message;
  const auto sum = [](const LoadResult& load) {
    return std::accumulate(load.force_n.begin(), load.force_n.end(), 0.0);
  };
  // T = Σ F cos α′ R with α′ between 20° and 35° here
  EXPECT_GT(sum(normal.load[0]), sum(along.load[0]) / std::cos(0.35));
  EXPECT_LT(sum(normal.load[0]), sum(along.load[0]) / std::cos(0.65));
}

TEST(Variants, RotationShortOfContactIsAResultThatSaysSo) {
  Gear gear = seed_gear();
  gear.load.torque_nm.clear();
  gear.load.rotation_rad = {1e-4};
  const ForwardResult result = model().analyze(gear);
  EXPECT_EQ(result.status, Status::ok);
  EXPECT_EQ(result.load[0].engaged_count, 0);
  EXPECT_EQ(result.load[0].torque_nm, 0.0);
  EXPECT_NE(result.message.find("no tooth is in contact"), std::string::npos);
}

TEST(Variants, InterferenceIsReportedAndStillSolved) {
  Gear gear = seed_gear();
  gear.circular_spline.profile_shift = 2.1;
  const ForwardResult result = model().analyze(gear);
  EXPECT_EQ(result.status, Status::ok);
  EXPECT_TRUE(result.backlash->interference);
  EXPECT_NE(result.message.find("interfere"), std::string::npos);
  EXPECT_EQ(result.stiffness->take_up_rad, 0.0);
}

TEST(Variants, GearsWithoutAResultSayWhy) {
  Gear gear = seed_gear();
  gear.wave_generator.eccentricity_mm = 0.2; // e/u0 = 1: no wrap
  const ForwardResult no_wrap = model().analyze(gear);
  EXPECT_EQ(no_wrap.status, Status::no_wrap);
  EXPECT_NE(no_wrap.message.find("0.2"), std::string::npos);
  gear = seed_gear();
  gear.contact.fidelity = Fidelity::nonlinear;
  EXPECT_EQ(model().analyze(gear).status, Status::not_available);
  gear = seed_gear();
  gear.flexspline.tip_radius_mm = 14.0; // below the root circle
  EXPECT_EQ(model().analyze(gear).status, Status::contradiction);
}

TEST(Variants, JsonHasTheKeysOfTheInterfaceAndNullWhereFlanksDoNotMeet) {
  const auto json = nlohmann::json::parse(result_json_text(model().analyze(seed_gear())));
  for (const char* key : {"gear", "fidelity", "version", "status", "message", "wave_generator", "backlash",
                          "assembly", "compliance", "load", "stiffness", "certificate", "stages"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["status"], "ok");
  EXPECT_TRUE(json["backlash"]["contact_radius_mm"][0].is_null());
  EXPECT_EQ(json["backlash"]["tooth"].size(), 70U);
  EXPECT_EQ(json["load"].size(), 3U);
  EXPECT_EQ(json["load"][0]["force_n"].size(), json["load"][0]["phi_deg"].size());
  EXPECT_EQ(json["compliance"]["matrix_um_per_n"].size(), json["compliance"]["tooth"].size());
}

TEST(CertificateLimits, OneBadResidualIsEnoughToFail) {
  Certificate good;
  EXPECT_TRUE(good.holds());
  const auto poisoned = [&](auto change) {
    Certificate c = good;
    change(c);
    return c.holds();
  };
  EXPECT_FALSE(poisoned([](Certificate& c) { c.complementarity = 1e-6; }));
  EXPECT_FALSE(poisoned([](Certificate& c) { c.min_gap_um = -1e-3; }));
  EXPECT_FALSE(poisoned([](Certificate& c) { c.min_force_n = -1e-6; }));
  EXPECT_FALSE(poisoned([](Certificate& c) { c.reciprocity = 1e-6; }));
  EXPECT_FALSE(poisoned([](Certificate& c) { c.equilibrium = 1e-6; }));
  EXPECT_FALSE(poisoned([](Certificate& c) { c.exact_gap_residual_um = 1e-3; }));
  EXPECT_FALSE(poisoned([](Certificate& c) { c.equilibrium = std::nan(""); }));
}

} // namespace
} // namespace strainwave
