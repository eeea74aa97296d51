// Gears that contradict themselves: the status, and a sentence with the offending numbers.

#include "strainwave/model/tooth/consistency.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace strainwave {
namespace {

TEST(Consistency, TheSeedGearIsConsistent) {
  const auto failure = find_contradiction(seed_gear());
  EXPECT_FALSE(failure.has_value()) << failure->message;
}

TEST(Consistency, ToothThicknessOfTheSeed) {
  // Involute functions by hand: r = 14, z = 140, x = 2.13, tip 14.584: half angle (pi/2 + 4.26 tan 20)/140 +
  // inv 20 - inv a, cos a = 13.155697/14.584.
  const ToothThickness thickness = tooth_thickness(seed_gear());
  const double tan20 = 0.36397023426620234, inv20 = tan20 - 0.3490658503988659;
  const double a = std::acos(14.0 * 0.9396926207859084 / 14.584);
  EXPECT_NEAR(thickness.flexspline_tip_mm,
              2.0 * 14.584 * ((1.5707963267948966 + 4.26 * tan20) / 140.0 + inv20 - (std::tan(a) - a)),
              1e-13);
  EXPECT_GT(thickness.circular_spline_tip_mm, 0.05);
}

struct Case {
  const char* name;
  std::function<void(Gear&)> spoil;
  Status status;
  const char* part; ///< of the sentence
};

TEST(Consistency, EveryContradictionHasItsSentence) {
  const Case cases[] = {
      {"teeth", [](Gear& g) { g.circular_spline.teeth = 141; }, Status::contradiction,
       "141 must be flexspline.teeth 140 + 2"},
      {"module", [](Gear& g) { g.flexspline.module_mm = 0.0; }, Status::contradiction, "module_mm 0"},
      {"nan", [](Gear& g) { g.flexspline.tip_radius_mm = std::nan(""); }, Status::contradiction,
       "tip_radius_mm nan"},
      {"pressure angle", [](Gear& g) { g.flexspline.pressure_angle_deg = 60.0; }, Status::contradiction,
       "60"},
      {"radii", [](Gear& g) { g.flexspline.tip_radius_mm = 14.1; }, Status::contradiction,
       "14.156 must be less than"},
      {"space radii", [](Gear& g) { g.circular_spline.tip_radius_mm = 14.9; }, Status::contradiction,
       "14.9 must be less than"},
      {"no involute",
       [](Gear& g) {
         g.flexspline.tip_radius_mm = 13.1;
         g.flexspline.root_radius_mm = 13.0;
       },
       Status::flank_outside_tooth, "13.1"},
      {"no involute in the space",
       [](Gear& g) {
         g.circular_spline.tip_radius_mm = 13.0;
         g.circular_spline.root_radius_mm = 13.2;
       },
       Status::flank_outside_tooth, "13.2"},
      {"pointed tooth", [](Gear& g) { g.flexspline.tip_radius_mm = 15.2; }, Status::contradiction,
       "tip thickness -"},
      {"pointed space tooth", [](Gear& g) { g.circular_spline.profile_shift = 4.0; }, Status::contradiction,
       "circular-spline tooth ends in a point"},
      {"closed space", [](Gear& g) { g.circular_spline.root_radius_mm = 15.6; }, Status::contradiction,
       "closes before"},
      {"overlapping teeth",
       [](Gear& g) { g.flexspline.profile_shift = 4.0, g.flexspline.tip_radius_mm = 14.2; },
       Status::contradiction, "overlap at root_radius_mm"},
      {"root clearance", [](Gear& g) { g.circular_spline.root_radius_mm = 14.7; }, Status::contradiction,
       "reach the ground"},
      {"rim", [](Gear& g) { g.flexspline.rim_thickness_mm = 0.31; }, Status::contradiction, "14.161"},
      {"wall", [](Gear& g) { g.flexspline.wall_thickness_mm = -0.1; }, Status::contradiction,
       "wall_thickness_mm -0.1"},
      {"diaphragm", [](Gear& g) { g.flexspline.diaphragm_thickness_mm = 0.0; }, Status::contradiction,
       "diaphragm"},
      {"boss", [](Gear& g) { g.flexspline.boss_radius_mm = 14.0; }, Status::contradiction,
       "boss_radius_mm 14"},
      {"face", [](Gear& g) { g.flexspline.face_width_mm = 27.5; }, Status::contradiction,
       "does not fit in the cup"},
      {"clearance", [](Gear& g) { g.flexspline.front_clearance_mm = -1.0; }, Status::contradiction,
       "front_clearance_mm -1"},
      {"disc in front", [](Gear& g) { g.wave_generator.contact_width_mm = 7.5; }, Status::contradiction,
       "open end"},
      {"disc behind",
       [](Gear& g) {
         g.flexspline.front_clearance_mm = 18.0;
         g.wave_generator.contact_width_mm = 13.8;
       },
       Status::contradiction, "into the diaphragm"},
      {"no disc", [](Gear& g) { g.wave_generator.contact_width_mm = 0.0; }, Status::contradiction,
       "contact_width_mm 0"},
      {"modification", [](Gear& g) { g.flank_modification.circular_spline.spline_um = {-1.0}; },
       Status::contradiction, "flank_modification.circular_spline"}};
  for (const Case& c : cases) {
    Gear gear = seed_gear();
    c.spoil(gear);
    const auto failure = find_contradiction(gear);
    ASSERT_TRUE(failure.has_value()) << c.name;
    EXPECT_EQ(failure->status, c.status) << c.name;
    EXPECT_NE(failure->message.find(c.part), std::string::npos) << c.name << ": " << failure->message;
  }
}

} // namespace
} // namespace strainwave
