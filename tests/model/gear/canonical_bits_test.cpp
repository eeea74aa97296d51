#include "strainwave/model/gear/fields.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace strainwave {
namespace {

TEST(CanonicalBits, OneUlpOfANumberChangesThem) {
  const Gear seed = seed_gear();
  Gear gear = seed;
  gear.flexspline.tip_radius_mm = std::nextafter(gear.flexspline.tip_radius_mm, 100.0);
  EXPECT_NE(canonical_bits(gear), canonical_bits(seed));
}

TEST(CanonicalBits, AbsentKeyIsNotZero) {
  Gear absent = seed_gear();
  Gear zero = absent;
  zero.contact.reference_section_mm = 0.0;
  EXPECT_NE(canonical_bits(absent), canonical_bits(zero));
}

TEST(CanonicalBits, ItemsDoNotMoveFromOneListToTheNext) {
  Gear one = seed_gear(), other = seed_gear();
  one.load.torque_nm = {1.0};
  one.load.rotation_rad = {};
  other.load.torque_nm = {};
  other.load.rotation_rad = {1.0};
  EXPECT_NE(canonical_bits(one), canonical_bits(other));
}

TEST(CanonicalBits, NameAndSignOfZeroDoNotCount) {
  Gear gear = seed_gear();
  gear.name = "another name";
  gear.wave_generator.disc_taper_um = -0.0;
  EXPECT_EQ(canonical_bits(gear), canonical_bits(seed_gear()));
}

TEST(CanonicalBits, OfSomeTablesIgnoreTheOthers) {
  constexpr std::array<std::string_view, 2> cup{"flexspline", "mesh"};
  Gear gear = seed_gear();
  gear.wave_generator.max_radial_deformation_mm = 0.19;
  gear.flank_modification.flexspline.tip_relief_um = 5.0; // another table of the same last name
  EXPECT_EQ(canonical_bits(gear, cup), canonical_bits(seed_gear(), cup));
  gear.mesh.per_pitch += 2;
  EXPECT_NE(canonical_bits(gear, cup), canonical_bits(seed_gear(), cup));
}

TEST(CanonicalBits, OfATableHoldTheTablesInsideIt) {
  constexpr std::array<std::string_view, 1> flanks{"flank_modification"};
  Gear gear = seed_gear();
  gear.flank_modification.circular_spline.slope_um = 1.0;
  EXPECT_NE(canonical_bits(gear, flanks), canonical_bits(seed_gear(), flanks));
}

} // namespace
} // namespace strainwave
