#include "strainwave/model/gear/fields.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace strainwave {
namespace {

Gear gear_with_spline() {
  Gear gear = seed_gear();
  gear.flank_modification.flexspline.spline_um = {0.0, 1.0, 2.0, 3.0};
  return gear;
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const FieldError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(NumberPath, ReadsAndWritesANumber) {
  Gear gear = seed_gear();
  const NumberPath u0("wave_generator.max_radial_deformation_mm");
  EXPECT_EQ(u0.get(gear), 0.2);
  u0.set(gear, 0.195);
  EXPECT_EQ(gear.wave_generator.max_radial_deformation_mm, 0.195);
}

TEST(NumberPath, ReadsAndWritesAnItemOfAList) {
  Gear gear = gear_with_spline();
  const NumberPath knot("flank_modification.flexspline.spline_um[3]");
  EXPECT_EQ(knot.get(gear), 3.0);
  knot.set(gear, 4.5);
  EXPECT_EQ(gear.flank_modification.flexspline.spline_um, (std::vector<double>{0.0, 1.0, 2.0, 4.5}));
  EXPECT_EQ(knot.path(), "flank_modification.flexspline.spline_um[3]");
}

TEST(NumberPath, WritesAnAbsentKey) {
  Gear gear = seed_gear();
  NumberPath("wave_generator.wrap_angle_deg").set(gear, 50.0);
  EXPECT_EQ(gear.wave_generator.wrap_angle_deg, 50.0);
}

TEST(NumberPath, WritesWholeNumbersOnlyToIntegers) {
  Gear gear = seed_gear();
  const NumberPath teeth("flexspline.teeth");
  teeth.set(gear, 160.0);
  EXPECT_EQ(gear.flexspline.teeth, 160);
  EXPECT_EQ(refusal([&] { teeth.set(gear, 160.5); }), "flexspline.teeth: must be a whole number, is 160.5");
  EXPECT_EQ(refusal([&] { teeth.set(gear, 1e300); }), "flexspline.teeth: must be a whole number, is 1e+300");
}

TEST(NumberPath, ChecksTheRange) {
  Gear gear = gear_with_spline();
  EXPECT_EQ(refusal([&] { NumberPath("flexspline.module_mm").set(gear, -0.2); }),
            "flexspline.module_mm: must be above 0 and at most 100 mm, is -0.2");
  EXPECT_EQ(refusal([&] { NumberPath("flank_modification.flexspline.spline_um[1]").set(gear, 1e4); }),
            "flank_modification.flexspline.spline_um[1]: every number of the list must be at least -1000 and "
            "at most 1000 "
            "µm, is 10000");
}

TEST(NumberPath, RefusesWhatIsNoNumber) {
  EXPECT_EQ(refusal([] { NumberPath("contact.fidelity"); }),
            "contact.fidelity: is not a number; it is one of the texts unilateral, linear or nonlinear");
  EXPECT_EQ(refusal([] { NumberPath("load.torque_nm"); }),
            "load.torque_nm: is a list; name one of its numbers, counted from 0: load.torque_nm[0]");
  EXPECT_EQ(refusal([] { NumberPath("flexspline.module_mm[0]"); }),
            "flexspline.module_mm[0]: is not a list, so it takes no [0]");
  EXPECT_EQ(refusal([] { NumberPath("flexspline.modul_mm"); }),
            "flexspline.modul_mm: no such key; did you mean module_mm?");
  EXPECT_EQ(refusal([] { NumberPath("load.torque_nm[x]"); }),
            "load.torque_nm[x]: no such key; did you mean torque_nm?");
}

TEST(NumberPath, RefusesWhatTheGearDoesNotHold) {
  const Gear gear = gear_with_spline();
  EXPECT_EQ(refusal([&] { NumberPath("wave_generator.wrap_angle_deg").get(gear); }),
            "wave_generator.wrap_angle_deg: this gear has no value for it");
  EXPECT_EQ(
      refusal([&] { NumberPath("flank_modification.flexspline.spline_um[4]").get(gear); }),
      "flank_modification.flexspline.spline_um[4]: this gear's list holds only 4 numbers, counted from 0");
}

} // namespace
} // namespace strainwave
