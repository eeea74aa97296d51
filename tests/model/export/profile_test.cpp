// Outlines against the involute by another formula, and against the backlash of the kinematics.

#include "strainwave/model/export/profile.hpp"

#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/tooth/backlash.hpp"
#include "strainwave/model/tooth/profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double pi = std::numbers::pi;

const Outline& find(const std::vector<Outline>& outlines, OutlineKind kind, int tooth = 0) {
  return *std::find_if(outlines.begin(), outlines.end(),
                       [&](const Outline& o) { return o.kind == kind && o.tooth == tooth; });
}

struct Involute {
  double r, half, alpha; // pitch radius, half tooth (space) angle there, pressure angle
  /// Polar angle of the drive flank at a radius: the pitch point's plus inv α0 − inv α.
  double angle(double radius) const {
    const double a = std::acos(r * std::cos(alpha) / radius);
    return half + (std::tan(alpha) - alpha) - (std::tan(a) - a);
  }
};
Involute involute_of(const Gear& gear, bool tooth) {
  const double alpha = gear.flexspline.pressure_angle_deg * pi / 180.0;
  const int teeth = tooth ? gear.flexspline.teeth : gear.circular_spline.teeth;
  const double shift = tooth ? gear.flexspline.profile_shift : gear.circular_spline.profile_shift;
  return {gear.flexspline.module_mm * teeth / 2.0, (pi / 2.0 + 2.0 * shift * std::tan(alpha)) / teeth, alpha};
}

double area(const Outline& outline) {
  double sum = 0.0;
  for (std::size_t k = 0; k < outline.points.size(); ++k) {
    const OutlinePoint &a = outline.points[k], &b = outline.points[(k + 1) % outline.points.size()];
    sum += 0.5 * (a.x_mm * b.y_mm - b.x_mm * a.y_mm);
  }
  return sum;
}

TEST(Profile, unmodified_flanks_lie_on_the_involute) {
  const Gear gear = seed_gear();
  const auto outlines = profile_outlines(gear);
  ASSERT_TRUE(outlines.ok());
  for (const bool tooth : {true, false}) {
    const Involute involute = involute_of(gear, tooth);
    int points = 0;
    for (const OutlinePoint& p : find(*outlines, tooth ? OutlineKind::tooth : OutlineKind::space).points) {
      if (p.part != OutlinePart::drive_flank && p.part != OutlinePart::coast_flank)
        continue;
      const double side = p.part == OutlinePart::drive_flank ? 1.0 : -1.0;
      EXPECT_NEAR(std::atan2(p.y_mm, p.x_mm), side * involute.angle(p.radius_mm()), 1e-13);
      ++points;
    }
    EXPECT_EQ(points, 2 * 41);
  }
}

TEST(Profile, flanks_run_from_root_circle_to_tip_circle) {
  const Gear gear = seed_gear();
  const auto outlines = profile_outlines(gear);
  ASSERT_TRUE(outlines.ok());
  for (const bool tooth : {true, false}) {
    double least = 1e9, most = 0.0;
    for (const OutlinePoint& p : find(*outlines, tooth ? OutlineKind::tooth : OutlineKind::space).points) {
      least = std::min(least, p.radius_mm());
      most = std::max(most, p.radius_mm());
    }
    EXPECT_NEAR(least, tooth ? gear.flexspline.root_radius_mm : gear.circular_spline.tip_radius_mm, 1e-12);
    EXPECT_NEAR(most, tooth ? gear.flexspline.tip_radius_mm : gear.circular_spline.root_radius_mm, 1e-12);
  }
}

TEST(Profile, removal_is_the_distance_to_the_unmodified_involute) {
  Gear gear = seed_gear();
  gear.flank_modification.flexspline.tip_relief_um = 12.0;
  gear.flank_modification.flexspline.crowning_um = 4.0;
  gear.flank_modification.circular_spline.slope_um = 5.0;
  const auto outlines = profile_outlines(gear);
  ASSERT_TRUE(outlines.ok()) << outlines.failure().message;
  for (const bool tooth : {true, false}) {
    const Involute involute = involute_of(gear, tooth);
    const double base = involute.r * std::cos(involute.alpha);
    double most = 0.0;
    for (const OutlinePoint& p : find(*outlines, tooth ? OutlineKind::tooth : OutlineKind::space).points) {
      if (p.part != OutlinePart::drive_flank)
        continue;
      // A point at distance m from an involute of base radius r_b lies on the parallel involute, turned by
      // m/r_b.
      const double turned = involute.angle(p.radius_mm()) - std::atan2(p.y_mm, p.x_mm);
      EXPECT_NEAR((tooth ? 1.0 : -1.0) * turned * base * 1e3, p.removal_um, 1e-9);
      most = std::max(most, p.removal_um);
    }
    EXPECT_GT(most, 4.9);
  }
}

TEST(Profile, assembled_flank_is_the_posed_flank_of_the_tooth_room) {
  const Gear gear = seed_gear();
  const auto outlines = profile_outlines(gear, {.teeth = {-7, 2, 20}});
  ASSERT_TRUE(outlines.ok());
  const auto pair = FlankPair::make(gear);
  const auto curve = NeutralCurve::make(gear.wave_generator, gear.flexspline);
  for (const int tooth : {-7, 2, 20}) {
    const Pose pose = curve->pose(2.0 * pi * tooth / gear.flexspline.teeth);
    const std::vector<PolarPoint> expected = posed_flank_profile(*pair, pose, 41);
    std::vector<OutlinePoint> drive;
    for (const OutlinePoint& p : find(*outlines, OutlineKind::assembled_tooth, tooth).points)
      if (p.part == OutlinePart::drive_flank)
        drive.insert(drive.begin(), p); // outlines run inwards there
    ASSERT_EQ(drive.size(), expected.size());
    for (std::size_t k = 0; k < drive.size(); ++k) {
      EXPECT_NEAR(drive[k].x_mm, expected[k].radius_mm * std::cos(expected[k].angle_rad), 1e-12);
      EXPECT_NEAR(drive[k].y_mm, expected[k].radius_mm * std::sin(expected[k].angle_rad), 1e-12);
    }
  }
}

TEST(Profile, assembled_outlines_stand_apart_by_the_initial_backlash) {
  const Gear gear = seed_gear();
  const int tooth = 2;
  const auto outlines = profile_outlines(gear, {.teeth = {tooth}, .flank_points = 2001});
  ASSERT_TRUE(outlines.ok());
  const auto curve = NeutralCurve::make(gear.wave_generator, gear.flexspline);
  const Backlash table = backlash(gear, *curve).value();
  const auto at = static_cast<std::size_t>(std::find(table.tooth.begin(), table.tooth.end(), tooth) -
                                           table.tooth.begin());
  // Arc between the polylines at every radius of the space's drive flank.
  std::vector<OutlinePoint> flank;
  for (const OutlinePoint& p : find(*outlines, OutlineKind::assembled_tooth, tooth).points)
    if (p.part == OutlinePart::drive_flank)
      flank.insert(flank.begin(), p);
  double least = 1e9;
  for (const OutlinePoint& p : find(*outlines, OutlineKind::assembled_space, tooth).points) {
    if (p.part != OutlinePart::drive_flank)
      continue;
    for (std::size_t k = 0; k + 1 < flank.size(); ++k) {
      const double low = flank[k].radius_mm(), high = flank[k + 1].radius_mm();
      if (p.radius_mm() < low || p.radius_mm() > high)
        continue;
      const double share = (p.radius_mm() - low) / (high - low);
      const double angle = (1.0 - share) * std::atan2(flank[k].y_mm, flank[k].x_mm) +
                           share * std::atan2(flank[k + 1].y_mm, flank[k + 1].x_mm);
      least = std::min(least, p.radius_mm() * (std::atan2(p.y_mm, p.x_mm) - angle));
    }
  }
  // The least is met between two of 2001 points 0.3 µm apart; its slope along the flank is below 0.05.
  EXPECT_NEAR(least, table.drive[at].backlash_mm, 2e-5);
}

TEST(Profile, outlines_are_closed_counter_clockwise_loops_without_double_points) {
  const auto outlines = profile_outlines(seed_gear());
  ASSERT_TRUE(outlines.ok());
  for (const Outline& outline : *outlines) {
    EXPECT_GT(area(outline), 0.0) << layer_name(outline.kind);
    for (std::size_t k = 0; k < outline.points.size(); ++k) {
      const OutlinePoint &a = outline.points[k], &b = outline.points[(k + 1) % outline.points.size()];
      EXPECT_GT(std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm), 1e-6)
          << layer_name(outline.kind) << " point " << k;
    }
  }
}

TEST(Profile, default_teeth_are_those_near_the_mesh) {
  const auto outlines = profile_outlines(seed_gear());
  ASSERT_TRUE(outlines.ok());
  int count = 0;
  for (const Outline& outline : *outlines)
    if (outline.kind == OutlineKind::assembled_tooth) {
      EXPECT_GE(outline.phi_deg, -10.0);
      EXPECT_LE(outline.phi_deg, 20.0);
      ++count;
    }
  EXPECT_EQ(count, 11); // −3 … 7 at 2.571° each
}

TEST(Profile, tooth_of_the_other_lobe_is_refused_with_its_angle) {
  const auto outlines = profile_outlines(seed_gear(), {.teeth = {40}});
  ASSERT_FALSE(outlines.ok());
  EXPECT_NE(outlines.failure().message.find("102.9"), std::string::npos) << outlines.failure().message;
}

} // namespace
} // namespace strainwave
