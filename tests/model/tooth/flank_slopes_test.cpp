// Derivatives of a single contact: against those of the whole backlash table, and against central differences
// where the table has none (fixed heights, height of the contact, direction of the normal, the coast flank).

#include "strainwave/model/tooth/backlash_gradient.hpp"
#include "strainwave/model/tooth/flank_slopes.hpp"
#include "strainwave/model/tooth/profile.hpp"
#include "tests/model/kinematics/order_of_convergence.hpp"

#include <gtest/gtest.h>

namespace strainwave::testing_support {
namespace {

const std::string fs = "flank_modification.flexspline.", cs = "flank_modification.circular_spline.";

Gear modified_gear() {
  Gear gear = seed_gear();
  FlankModification& m = gear.flank_modification.flexspline;
  m.tip_relief_um = 3.0;
  m.tip_relief_start = 0.6;
  m.root_relief_um = 1.0;
  m.crowning_um = 2.0;
  m.lead_taper_um = 4.0;
  gear.flank_modification.circular_spline.tip_relief_um = 1.0;
  return gear;
}

PoseSlopes standing(const NeutralCurve& curve, double phi, std::size_t parameters) {
  return {curve.pose(phi), Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(parameters))};
}

TEST(FlankSlopes, AgreeWithTheGradientOfTheBacklashTableOnBothFlanks) {
  const Gear gear = modified_gear();
  const NeutralCurve curve = NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
  const std::vector<std::string> paths = {fs + "tip_relief_um",
                                          fs + "tip_relief_start",
                                          fs + "crowning_um",
                                          fs + "lead_taper_um",
                                          cs + "tip_relief_um",
                                          "circular_spline.profile_shift",
                                          "circular_spline.tip_radius_mm",
                                          "flexspline.tip_radius_mm",
                                          fs + "slope_um",
                                          fs + "end_relief_um",
                                          cs + "crowning_um",
                                          cs + "root_relief_um",
                                          "flexspline.profile_shift"}; // more than one pass
  const double zeta = 0.4;
  const Backlash table = backlash(gear, curve, 0.25, zeta).value();
  const BacklashGradient gradient = backlash_gradient(gear, curve, table, paths);
  const FlankSlopes flanks(gear, paths, zeta);
  int compared = 0;
  for (std::size_t k = 0; k < table.tooth.size(); ++k) {
    for (const bool coast : {false, true}) {
      const ToothBacklash& contact = coast ? table.coast[k] : table.drive[k];
      if (!contact.overlap)
        continue;
      const double phi = table.phi_rad[k];
      const ContactSlopes slopes = flanks.at(
          standing(curve, phi, paths.size()), phi * gear.flexspline.teeth / gear.circular_spline.teeth,
          {.height = {}, .place = contact.place, .kink = contact.kink, .roll = contact.roll, .coast = coast});
      EXPECT_NEAR(slopes.gap_mm, contact.backlash_mm, 1e-14);
      EXPECT_NEAR(slopes.height, contact.flank_height, 1e-12);
      for (std::size_t j = 0; j < paths.size(); ++j) {
        const auto at = static_cast<Eigen::Index>(j);
        const std::size_t entry = k * paths.size() + j;
        const double gap = (coast ? gradient.coast_mm : gradient.drive_mm)[entry];
        const double radius = (coast ? gradient.coast_radius_mm : gradient.drive_radius_mm)[entry];
        EXPECT_NEAR(slopes.gap(at), gap, 1e-12 * std::abs(gap) + 1e-18) << paths[j];
        EXPECT_NEAR(slopes.radius(at), radius, 1e-9 * std::abs(radius) + 1e-15) << paths[j];
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(FlankSlopes, AtAFixedHeightConvergeWithOrderTwo) {
  Gear gear = modified_gear();
  const NeutralCurve curve = NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
  const std::vector<std::string> paths = {fs + "tip_relief_start"};
  const double phi = 0.1, space = phi * gear.flexspline.teeth / gear.circular_spline.teeth, zeta = -0.3,
               height = 0.9;
  const ContactSlopes slopes =
      FlankSlopes(gear, paths, zeta)
          .at(standing(curve, phi, 1), space, {.height = height, .place = ContactPlace::flank});
  const auto gap = [&](double x) {
    Gear changed = gear;
    changed.flank_modification.flexspline.tip_relief_start += x;
    return gap_at_height(FlankPair::make(changed, zeta).value(), curve.pose(phi), space, height)->gap_mm;
  };
  EXPECT_NEAR(slopes.gap_mm, gap(0.0), 1e-14);
  EXPECT_EQ(slopes.height_slope(0), 0.0);
  const OrderReport report = order_of_convergence(gap, slopes.gap(0), 1e-2, 1e-15);
  EXPECT_TRUE(report.good) << report.text;
}

TEST(FlankSlopes, HeightOfAnInnerContactMovesWithTheReliefThatPushesItDown) {
  const Gear gear = modified_gear();
  const NeutralCurve curve = NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
  const std::vector<std::string> paths = {fs + "crowning_um"};
  const double phi = 0.12, space = phi * gear.flexspline.teeth / gear.circular_spline.teeth;
  const auto contact = [&](double x) {
    Gear changed = gear;
    changed.flank_modification.flexspline.crowning_um += x;
    return FlankPair::make(changed)->drive(curve.pose(phi), space);
  };
  const ToothBacklash at = contact(0.0);
  ASSERT_EQ(at.place, ContactPlace::flank);
  const ContactSlopes slopes = FlankSlopes(gear, paths, 0.0)
                                   .at(standing(curve, phi, 1), space,
                                       {.height = {}, .place = at.place, .kink = at.kink, .roll = at.roll});
  // the place of a least value is known to the root of rounding over its curvature
  const OrderReport report = order_of_convergence([&](double x) { return contact(x).flank_height; },
                                                  slopes.height_slope(0), 5e-2, 1e-10);
  EXPECT_TRUE(report.good) << report.text;
}

TEST(FlankSearch, BreaksOfTwoReliefsAtOnePlaceAreOneKink) {
  // Both start in the middle of the flank by default; the contact there stays at the kink, whichever way the
  // pose moves.
  Gear gear = seed_gear();
  gear.flank_modification.flexspline.tip_relief_um = 2.0;
  gear.flank_modification.flexspline.root_relief_um = 1.0;
  gear.flank_modification.flexspline.crowning_um = 0.5;
  const NeutralCurve curve = NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
  const double phi = -2.57 * M_PI / 180.0, space = phi * gear.flexspline.teeth / gear.circular_spline.teeth;
  const ToothBacklash at = FlankPair::make(gear)->drive(curve.pose(phi), space);
  EXPECT_EQ(at.place, ContactPlace::flexspline_kink);
  EXPECT_NEAR(at.flank_height, 0.5, 1e-12);
  // apart by a hair: the same contact
  gear.flank_modification.flexspline.tip_relief_start += 1e-6;
  const ToothBacklash apart = FlankPair::make(gear)->drive(curve.pose(phi), space);
  EXPECT_EQ(apart.place, at.place);
  EXPECT_NEAR(apart.backlash_mm, at.backlash_mm, 1e-12);
}

} // namespace
} // namespace strainwave::testing_support
