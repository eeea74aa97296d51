// The search for the least gap: against brute force for modified flanks, and the properties that every gear
// must show.

#include "strainwave/model/tooth/backlash.hpp"
#include "tests/model/tooth/brute_force.hpp"
#include "tests/model/tooth/curve_of.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace strainwave::testing_support {
namespace {

constexpr double pi = std::numbers::pi;

/// Every key of the modification in use, with minima inside the flank and at kinks.
Gear modified(int variant) {
  Gear gear = seed_gear();
  gear.wave_generator.shape = variant % 2 ? WaveGeneratorShape::two_disc_exact : WaveGeneratorShape::two_disc;
  FlankModification& f = gear.flank_modification.flexspline;
  FlankModification& c = gear.flank_modification.circular_spline;
  switch (variant) {
  case 1:
    f.tip_relief_um = 12.0, f.tip_relief_start = 0.6, f.tip_relief_power = 1.0;
    break;
  case 2:
    f.tip_relief_um = 8.0, f.tip_relief_power = 2.5, f.root_relief_um = 6.0, c.crowning_um = 4.0;
    break;
  case 3:
    c.tip_relief_um = 10.0, c.tip_relief_start = 0.4, c.root_relief_um = 5.0, c.root_relief_start = 0.3;
    break;
  case 4:
    f.spline_um = {6.0, 1.5, 4.0, 2.0, 2.0, 9.0}, c.spline_um = {5.0, 1.0, 6.0};
    break;
  case 5:
    f.slope_um = -7.0, c.slope_um = 3.0, f.spline_um = {2.0}, c.spline_um = {1.0, 3.0};
    break;
  case 6:
    f.lead_taper_um = 6.0, f.end_relief_um = 4.0, f.end_relief_length_mm = 2.0, c.lead_crowning_um = 3.0;
    break;
  default:
    break;
  }
  return gear;
}

TEST(BacklashSearch, AgreesWithBruteForceForEveryKindOfModification) {
  for (int variant = 0; variant <= 6; ++variant) {
    const Gear gear = modified(variant);
    const bool kinked = variant >= 1 && variant <= 3;
    const NeutralCurve curve = curve_of(gear);
    for (const double zeta : {0.0, 0.8}) {
      const auto result = backlash(gear, curve, 0.3, zeta);
      ASSERT_TRUE(result.ok());
      for (std::size_t k = 0; k < result->tooth.size(); k += 5) {
        const double phi = result->phi_rad[k];
        const Pose pose = curve.pose(phi);
        const Pose mirror{pose.rho_mm, -pose.phi1_rad, -pose.normal_rotation_rad};
        const BruteForce drive = brute_force_backlash(gear, pose, phi * 140.0 / 142.0, zeta);
        const BruteForce coast = brute_force_backlash(gear, mirror, -phi * 140.0 / 142.0, zeta);
        SCOPED_TRACE(::testing::Message() << "variant " << variant << " phi " << phi << " zeta " << zeta);
        ASSERT_EQ(result->drive[k].overlap, drive.overlap);
        // Chords of 4000 points on 0.5 mm: sagitta 1e-4^2/(8 * 5) mm, and a smooth minimum between points is
        // as flat. Beside a kink (slopes differ by up to 0.07) the nearest point may be half a spacing
        // of 1.2e-4 mm away, on the high side.
        if (drive.overlap) {
          EXPECT_LT(result->drive[k].backlash_mm, drive.backlash_mm + 3e-9);
          EXPECT_GT(result->drive[k].backlash_mm, drive.backlash_mm - (kinked ? 4e-6 : 3e-9));
        }
        if (coast.overlap) {
          EXPECT_LT(result->coast[k].backlash_mm, coast.backlash_mm + 3e-9);
          EXPECT_GT(result->coast[k].backlash_mm, coast.backlash_mm - (kinked ? 4e-6 : 3e-9));
        }
      }
    }
  }
}

TEST(BacklashSearch, FindsTheDeepestOfSeveralDips) {
  Gear gear = seed_gear();
  gear.flank_modification.flexspline.spline_um = {20.0, 8.0, 20.0, 7.9, 20.0, 8.1, 20.0};
  const NeutralCurve curve = curve_of(gear);
  const auto result = backlash(gear, curve);
  for (std::size_t k = 0; k < result->tooth.size(); k += 3) {
    const double phi = result->phi_rad[k];
    const BruteForce expected = brute_force_backlash(gear, curve.pose(phi), phi * 140.0 / 142.0, 0.0, 8000);
    ASSERT_EQ(result->drive[k].overlap, expected.overlap);
    if (!expected.overlap)
      continue;
    EXPECT_NEAR(result->drive[k].backlash_mm, expected.backlash_mm,
                1e-8); // flatness 20 times that of the plain flank
    EXPECT_NEAR(result->drive[k].contact_radius_mm, expected.radius_mm, 2e-4);
  }
}

TEST(Backlash, CoastIsTheMirrorImageOfDrive) {
  const Gear gear = modified(4);
  const NeutralCurve curve = curve_of(gear);
  const auto here = backlash(gear, curve, 0.25), mirrored = backlash(gear, curve, -0.25);
  std::size_t compared = 0;
  for (std::size_t k = 0; k < here->tooth.size(); ++k)
    for (std::size_t l = 0; l < mirrored->tooth.size(); ++l)
      if (mirrored->tooth[l] == -here->tooth[k]) {
        ASSERT_EQ(here->coast[k].overlap, mirrored->drive[l].overlap);
        EXPECT_NEAR(here->coast[k].backlash_mm, mirrored->drive[l].backlash_mm, 1e-14);
        ++compared;
      }
  EXPECT_EQ(compared, 70u);
}

TEST(Backlash, APhaseOfOnePitchRenumbersTheTeeth) {
  const Gear gear = modified(2);
  const NeutralCurve curve = curve_of(gear);
  const auto zero = backlash(gear, curve, 0.0), one = backlash(gear, curve, 1.0);
  ASSERT_EQ(zero->tooth.size(), one->tooth.size());
  for (std::size_t k = 0; k < zero->tooth.size(); ++k) {
    EXPECT_EQ(one->tooth[k], zero->tooth[k] - 1);
    EXPECT_NEAR(one->drive[k].backlash_mm, zero->drive[k].backlash_mm, 1e-13);
  }
}

TEST(Backlash, AnglesAreHalfOpenAndTheMinorAxisBelongsToTheUpperEnd) {
  const auto result = backlash(seed_gear(), curve_of(seed_gear()));
  ASSERT_EQ(result->tooth.size(), 70u);
  EXPECT_EQ(result->tooth.front(), -34);
  EXPECT_EQ(result->tooth.back(), 35);
}

TEST(Backlash, WindowTakesItsEndsIn) {
  Gear gear = seed_gear();
  gear.contact.window_deg = {-18.0, 36.0}; // teeth -7 and 14 exactly
  const auto result = backlash(gear, curve_of(gear));
  ASSERT_EQ(result->tooth.size(), 22u);
  EXPECT_EQ(result->tooth.front(), -7);
  EXPECT_EQ(result->tooth.back(), 14);
}

TEST(Backlash, OddToothNumbersAreUnfolded) {
  // 141/143 teeth at nearly the seed's size: the lobes differ by half a pitch.
  Gear gear = seed_gear();
  gear.flexspline.teeth = 141;
  gear.circular_spline.teeth = 143;
  gear.flexspline.module_mm = 28.0 / 141.0;
  const NeutralCurve curve = curve_of(gear);
  const auto ring = backlash(gear, curve);
  ASSERT_TRUE(ring.ok());
  ASSERT_EQ(ring->tooth.size(), 141u);
  for (std::size_t k = 0; k < 141; ++k) {
    EXPECT_NEAR(ring->phi_rad[k], 2.0 * pi * ring->tooth[k] / 141.0, 1e-13);
    if (k > 0) {
      EXPECT_GT(ring->phi_rad[k], ring->phi_rad[k - 1]);
    }
    EXPECT_EQ(ring->lobe[k], ring->phi_rad[k] > 0.5 * pi ? 1 : 0);
    // The space stands at pi + (phi - pi) z1/z2 on the second lobe.
    const double folded = ring->phi_rad[k] - ring->lobe[k] * pi;
    const BruteForce expected =
        brute_force_backlash(gear, curve.pose(folded), folded * 141.0 / 143.0, 0.0, 1000);
    ASSERT_EQ(ring->drive[k].overlap, expected.overlap);
    if (expected.overlap) {
      EXPECT_NEAR(ring->drive[k].backlash_mm, expected.backlash_mm, 1e-7);
    }
  }
}

TEST(Backlash, RemovalNeverBringsFlanksNearer) {
  const Gear plain = seed_gear();
  const NeutralCurve curve = curve_of(plain);
  const auto before = backlash(plain, curve);
  for (int variant = 1; variant <= 6; ++variant) {
    Gear gear = modified(variant);
    gear.wave_generator = plain.wave_generator;
    const auto after = backlash(gear, curve, 0.0, 0.5);
    for (std::size_t k = 0; k < before->tooth.size(); ++k)
      // Rounded edges may shorten the common stretch by the removal, never lengthen it beyond 1e-12.
      if (before->drive[k].overlap && after->drive[k].overlap) {
        EXPECT_GT(after->drive[k].backlash_mm, before->drive[k].backlash_mm - 1e-12) << variant << " " << k;
      }
  }
}

TEST(Backlash, EqualRemovalEverywhereOpensTheGapByItsArc) {
  // A normal removal of m opens the arc by about m/cos(angle between normal and circle); here the flanks are
  // near 20 to 25 degrees.
  Gear gear = seed_gear();
  const NeutralCurve curve = curve_of(gear);
  const auto before = backlash(gear, curve);
  gear.flank_modification.flexspline.spline_um = {1.0};
  const auto after = backlash(gear, curve);
  for (std::size_t k = 0; k < before->tooth.size(); ++k)
    if (before->drive[k].overlap) {
      const double opened = 1e3 * (after->drive[k].backlash_mm - before->drive[k].backlash_mm);
      EXPECT_GT(opened, 1.0);
      EXPECT_LT(opened, 1.2);
    }
}

TEST(Backlash, FlanksThatShareNoRadiusAreAFailureWithTheNumbers) {
  Gear gear = seed_gear();
  gear.circular_spline.tip_radius_mm = 14.85;
  gear.wave_generator.max_radial_deformation_mm = 0.1;
  gear.wave_generator.eccentricity_mm = 0.3;
  const auto result = backlash(gear, curve_of(gear));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.failure().status, Status::no_overlap);
  EXPECT_NE(result.failure().message.find("14.85"), std::string::npos);
  EXPECT_EQ(least_backlash(gear, curve_of(gear)).failure().status, Status::no_overlap);
}

TEST(Backlash, RepeatsToTheLastBit) {
  const Gear gear = modified(4);
  const auto a = backlash(gear, curve_of(gear)), b = backlash(gear, curve_of(gear));
  for (std::size_t k = 0; k < a->drive.size(); ++k)
    EXPECT_EQ(std::memcmp(&a->drive[k].backlash_mm, &b->drive[k].backlash_mm, sizeof(double)), 0);
}

TEST(LeastBacklash, IsNoHigherThanADenseScan) {
  for (int variant = 0; variant <= 6; ++variant) {
    Gear gear = modified(variant);
    const NeutralCurve curve = curve_of(gear);
    const FlankPair pair = FlankPair::make(gear).value();
    const auto least = least_backlash(gear, curve);
    ASSERT_TRUE(least.ok());
    double scan = 1.0;
    for (int i = -1800; i <= 1800; ++i) {
      const double phi = i * 0.05 * pi / 180.0;
      const ToothBacklash at = pair.drive(curve.pose(phi), phi * 140.0 / 142.0);
      if (at.overlap)
        scan = std::min(scan, at.backlash_mm);
    }
    EXPECT_LE(least->backlash_mm, scan + 1e-15);
    EXPECT_GT(least->backlash_mm, scan - 2e-6); // the scan's step of 0.05 degrees
  }
}

TEST(LeastBacklash, StaysInTheWindow) {
  Gear gear = seed_gear();
  gear.contact.window_deg = {8.0, 30.0};
  const auto least = least_backlash(gear, curve_of(gear));
  EXPECT_NEAR(least->phi_rad, 8.0 * pi / 180.0, 1e-14);
}

} // namespace
} // namespace strainwave::testing_support
