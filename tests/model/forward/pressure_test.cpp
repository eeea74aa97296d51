// Contact pressure: textbook numbers for two cylinders, the limits of a nearly conforming flank, and a
// seed-gear tooth computed by hand from involute radii.

#include "strainwave/model/export/result_json.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/meshing/pressure.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <numeric>

namespace strainwave {
namespace {

TEST(LineContact, TwoSteelCylindersHaveTheTextbooksPressureAndWidth) {
  // Steel on steel, ν = 0.3 (Roark's table for cylinders, Niemann): p0 = 0.418 √(w E/R), width 2 b = 2.15 √(w
  // K/E) with K = D1 D2/(D1 + D2) = 2 R. The printed constants have three digits.
  const Material steel{.youngs_modulus_mpa = 206000.0, .poisson_ratio = 0.3};
  const double r1 = 20.0, r2 = 30.0, w = 500.0;
  const double r = 1.0 / (1.0 / r1 + 1.0 / r2);
  const LineContact c = line_contact(w, 1.0 / r, contact_modulus_mpa(steel), 100.0);
  EXPECT_NEAR(c.pressure_mpa, 0.418 * std::sqrt(w * 206000.0 / r), 0.001 * c.pressure_mpa);
  EXPECT_NEAR(2.0 * c.half_width_mm, 2.15 * std::sqrt(w * 2.0 * r / 206000.0),
              0.0025 * 2.0 * c.half_width_mm);
  // the elliptic pressure carries the load
  EXPECT_NEAR(0.5 * std::numbers::pi * c.pressure_mpa * c.half_width_mm, w, 1e-12 * w);
}

TEST(LineContact, NeverSpreadsOverMoreThanItsShare) {
  const double modulus = 113187.0;
  for (const double curvature : {1e-9, 0.0, -0.5}) {
    const LineContact c = line_contact(10.0, curvature, modulus, 0.1);
    EXPECT_DOUBLE_EQ(c.half_width_mm, 0.05);
    EXPECT_DOUBLE_EQ(c.pressure_mpa, 100.0);
  }
  // continuous where Hertz' pressure meets the mean: b = 2 share/π
  const double b = 0.2 / std::numbers::pi;
  const double curvature = 4.0 * 10.0 / (std::numbers::pi * modulus * b * b);
  EXPECT_NEAR(line_contact(10.0, curvature * (1.0 + 1e-9), modulus, 0.1).pressure_mpa,
              line_contact(10.0, curvature * (1.0 - 1e-9), modulus, 0.1).pressure_mpa, 1e-6);
  EXPECT_EQ(line_contact(0.0, 1.0, modulus, 0.1).pressure_mpa, 0.0);
}

TEST(FlankPressure, OneToothByHand) {
  // One point, 12 N circumferential, flank radius 14.5, contact radius 14.7: tangents to the base circles 14
  // cos 20° and 14.2 cos 20°; N = F/cos α, w = N/6 mm; Johnson's formulas in their √(w E*/(π R)) form.
  const Gear gear = seed_gear();
  const LoadedPoint point{.tooth = 0, .contact_radius_mm = 14.7, .flank_radius_mm = 14.5, .z_mm = 24.5};
  const double cosine = std::cos(20.0 * std::numbers::pi / 180.0);
  const double rho1 = std::sqrt(14.5 * 14.5 - std::pow(14.0 * cosine, 2));
  const double rho2 = std::sqrt(14.7 * 14.7 - std::pow(14.2 * cosine, 2));
  const double w = 12.0 / (14.2 * cosine / 14.7) / 6.0;
  const double inverse_r = 1.0 / rho1 - 1.0 / rho2;
  const double expected = std::sqrt(w * 206000.0 / (2.0 * 0.91) * inverse_r / std::numbers::pi);
  const LineContact found = FlankPressure(gear).of({point}, {12.0}).front();
  EXPECT_NEAR(found.pressure_mpa, expected, 1e-9 * expected);
  EXPECT_NEAR(found.half_width_mm, 2.0 * w / (std::numbers::pi * expected), 1e-9);

  Gear normal = gear; // the force is then the normal one already
  normal.contact.force_direction = ForceDirection::flank_normal;
  EXPECT_NEAR(FlankPressure(normal).of({point}, {12.0}).front().pressure_mpa,
              expected * std::sqrt(14.2 * cosine / 14.7), 1e-9 * expected);
}

TEST(FlankPressure, SharesOfHeightsAndSlicesCoverFlankAndFace) {
  // Conforming flanks everywhere, so that pressure = force over share: equal pressures give back the areas.
  Gear gear = seed_gear();
  gear.contact.force_direction = ForceDirection::flank_normal;
  gear.contact.face_slices = 3;
  std::vector<LoadedPoint> points;
  for (int slice = 0; slice < 3; ++slice) {
    for (const double r : {14.3, 14.4, 14.584}) // contact radius below the flank's: conforming
      points.push_back(
          {.contact_radius_mm = r - 0.5, .flank_radius_mm = r, .slice = slice, .z_mm = 21.5 + 3.0 * slice});
  }
  const auto contacts = FlankPressure(gear).of(points, std::vector<double>(points.size(), 2.0));
  double area = 0.0;
  for (const LineContact& c : contacts)
    area += 2.0 / c.pressure_mpa;
  const double base = 14.0 * std::cos(20.0 * std::numbers::pi / 180.0);
  EXPECT_NEAR(area, 6.0 * (14.584 * 14.584 - 14.3 * 14.3) / (2.0 * base), 1e-10);
}

TEST(FlankPressure, ResultNamesTheLargestAndItsPlace) {
  Gear gear = seed_gear();
  gear.contact.window_deg = {-21.0, 51.0};
  gear.contact.flank_points = 5;
  gear.contact.face_slices = 3;
  gear.load.torque_nm = {7.0};
  gear.load.phases = 2;
  ForwardModel model({.disk_cache = false});
  const auto json = result_json(model.analyze(gear))["load"][0];
  const auto& p = json["points"];
  double largest = 0.0;
  for (std::size_t i = 0; i < p["pressure_mpa"].size(); ++i) {
    const double pressure = p["pressure_mpa"][i];
    EXPECT_EQ(pressure > 0.0, p["force_n"][i].get<double>() > 0.0);
    EXPECT_EQ(pressure > 0.0, p["half_width_um"][i].get<double>() > 0.0);
    largest = std::max(largest, pressure);
  }
  const double peak = json["peak_pressure_mpa"];
  EXPECT_GE(peak, largest); // over both phases
  if (json["peak_pressure_at"]["phase"] == json["peak_phase"]) {
    EXPECT_EQ(peak, largest);
  }
  double of_teeth = 0.0;
  for (const double pressure : json["pressure_mpa"])
    of_teeth = std::max(of_teeth, pressure);
  EXPECT_EQ(of_teeth, largest);
  EXPECT_GT(peak, 10.0); // MPa: tens, as nearly conforming steel flanks have under some 50 N
  EXPECT_LT(peak, 1000.0);
}

} // namespace
} // namespace strainwave
