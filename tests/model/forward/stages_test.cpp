// What runs again, what is reused and what is skipped.

#include "strainwave/model/forward/forward.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

StageStatus status_of(const ForwardResult& result, const std::string& name) {
  for (const Stage& stage : result.stages) {
    if (stage.name == name)
      return stage.status;
  }
  ADD_FAILURE() << "no stage " << name;
  return StageStatus::skipped;
}

TEST(Stages, BacklashAloneTouchesNoFiniteElements) {
  ForwardModel model({.disk_cache = false});
  const ForwardResult result = model.analyze(seed_gear(), Want::backlash);
  EXPECT_EQ(status_of(result, "backlash"), StageStatus::computed);
  for (const char* skipped : {"flexspline", "assembly", "compliance", "load"}) {
    EXPECT_EQ(status_of(result, skipped), StageStatus::skipped) << skipped;
  }
  EXPECT_FALSE(result.assembly || result.compliance || result.certificate);
}

TEST(Stages, OnlyTheCupRunsTheFiniteElementsAgain) {
  ForwardModel model({.disk_cache = false});
  ASSERT_EQ(status_of(model.analyze(seed_gear()), "flexspline"), StageStatus::computed);
  const std::pair<const char*, void (*)(Gear&)> changes[] = {
      {"u0", [](Gear& g) { g.wave_generator.max_radial_deformation_mm = 0.199; }},
      {"e", [](Gear& g) { g.wave_generator.eccentricity_mm = 0.61; }},
      {"disc width", [](Gear& g) { g.wave_generator.contact_width_mm = 3.5; }},
      {"tip relief", [](Gear& g) { g.flank_modification.flexspline.tip_relief_um = 3.0; }},
      {"load", [](Gear& g) { g.load.torque_nm = {2.5}; }},
      {"phases", [](Gear& g) { g.load.phases = 2; }},
      {"window",
       [](Gear& g) {
         g.contact.window_deg = {-21.0, 51.0};
       }},
      {"circular spline", [](Gear& g) { g.circular_spline.profile_shift = 2.2; }}};
  for (const auto& [name, change] : changes) {
    Gear gear = seed_gear();
    change(gear);
    const ForwardResult result = model.analyze(gear);
    EXPECT_EQ(result.status, Status::ok) << name << ": " << result.message;
    EXPECT_EQ(status_of(result, "flexspline"), StageStatus::reused) << name;
  }
  Gear thicker = seed_gear();
  thicker.flexspline.wall_thickness_mm = 0.31;
  EXPECT_EQ(status_of(model.analyze(thicker), "flexspline"), StageStatus::computed);
}

TEST(Stages, AssemblyIsReusedWhenOnlyFlanksOrLoadsChange) {
  ForwardModel model({.disk_cache = false});
  ASSERT_EQ(status_of(model.analyze(seed_gear()), "assembly"), StageStatus::computed);
  Gear gear = seed_gear();
  gear.flank_modification.flexspline.tip_relief_um = 3.0;
  gear.load.torque_nm = {3.0};
  EXPECT_EQ(status_of(model.analyze(gear), "assembly"), StageStatus::reused);
  gear.wave_generator.disc_taper_um = 5.0;
  EXPECT_EQ(status_of(model.analyze(gear), "assembly"), StageStatus::computed);
}

TEST(Stages, ResultsDoNotDependOnWhatWasAnalysedBefore) {
  Gear other = seed_gear();
  other.wave_generator.max_radial_deformation_mm = 0.197;
  other.load.torque_nm = {9.0};
  ForwardModel warm({.disk_cache = false});
  (void)warm.analyze(other);
  const ForwardResult after = warm.analyze(seed_gear());
  const ForwardResult fresh = ForwardModel({.disk_cache = false, .threads = 1}).analyze(seed_gear());
  ASSERT_EQ(after.load.size(), fresh.load.size());
  for (std::size_t i = 0; i < fresh.load.size(); ++i) {
    EXPECT_EQ(after.load[i].force_n, fresh.load[i].force_n); // bit for bit
    EXPECT_EQ(after.load[i].rotation_rad, fresh.load[i].rotation_rad);
  }
}

} // namespace
} // namespace strainwave
