// Poses of the coned cup against a nonlinear solution: run n2z of reference/assembly.json (large deformation,
// edge contact at the spatial disc edges), smooth cup, five sections, φ ≤ 20°. The figures are what small
// displacements can give.

#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/model/meshing/flank_points.hpp"

#include "tests/model/contact/reference_cup.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace strainwave {
namespace {

struct Difference {
  double radial_um = 0.0, tangential_um = 0.0, rotation_rad = 0.0;
};

constexpr std::array sections = {"21.5", "22.5", "24.5", "26.5", "27.5"};

/// One for each section.
std::array<Difference, 5> differences(double up_to_deg) {
  static const UnitResponses responses = [] {
    const Gear gear = seed_gear();
    ResponseRequest request;
    request.flexspline = gear.flexspline;
    request.material = gear.material;
    request.mesh = gear.mesh;
    request.teeth = false;
    request.sectors = 144; // 5° = 2 sectors
    request.section_z_mm = {21.5, 22.5, 23.5, 24.5, 25.5, 26.5, 27.5};
    request.estimate = false;
    return unit_responses(request).value();
  }();
  const RingCompliance ring(responses, {22.5, 24.5, 26.5}, true);
  const WaveGeneratorSurface discs(
      {.eccentricity_mm = 0.6, .neutral_disc_radius_mm = 13.606, .middle_z_mm = 24.5}, 13.856, 0.15);
  ContactSolver solver;
  const AssembledState assembled = assemble(ring, discs, 0.0, solver).value();
  const auto json = testing_support::reference("assembly.json");
  std::array<Difference, 5> all;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const char* z = sections[k];
    Difference& largest = all[k];
    const AssembledPoses poses(ring, assembled, 14.006, 0.0, {std::stod(z)});
    for (const auto& point : json["runs"]["n2z"]["stations"][z]) {
      const double degrees = point["phi_deg"];
      if (degrees > up_to_deg)
        continue;
      const double phi = degrees * std::numbers::pi / 180.0;
      const Pose pose = poses.pose(static_cast<int>(std::lround(degrees / 2.5)), phi, 0);
      const double expected_rho = 14.006 + point["rho_minus_rm_mm"].get<double>();
      largest.radial_um = std::max(largest.radial_um, 1e3 * std::abs(pose.rho_mm - expected_rho));
      largest.tangential_um =
          std::max(largest.tangential_um,
                   1e3 * 14.006 * std::abs(pose.phi1_rad - phi - point["phi1_minus_phi_rad"].get<double>()));
      largest.rotation_rad = std::max(
          largest.rotation_rad, std::abs(pose.normal_rotation_rad - point["theta_n_rad"].get<double>()));
    }
  }
  return all;
}

/// Largest over the sections; every section's figures go into the test's record, as docs/flank-contact.md has
/// them.
Difference largest_difference(double up_to_deg) {
  Difference largest;
  const auto all = differences(up_to_deg);
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const Difference& d = all[k];
    ::testing::Test::RecordProperty(std::string("z_") + sections[k],
                                    std::to_string(d.radial_um) + " um, " + std::to_string(d.tangential_um) +
                                        " um, " + std::to_string(1e4 * d.rotation_rad) + "e-4 rad");
    largest.radial_um = std::max(largest.radial_um, d.radial_um);
    largest.tangential_um = std::max(largest.tangential_um, d.tangential_um);
    largest.rotation_rad = std::max(largest.rotation_rad, d.rotation_rad);
  }
  return largest;
}

TEST(AssembledPoses, StandWhereTheNonlinearSolutionHasThemNearTheMesh) {
  const Difference d = largest_difference(20.0);
  RecordProperty("radial_um", std::to_string(d.radial_um));
  RecordProperty("tangential_um", std::to_string(d.tangential_um));
  RecordProperty("rotation_rad", std::to_string(d.rotation_rad));
  EXPECT_LE(d.radial_um, 1.5);
  EXPECT_LE(d.tangential_um, 0.2);
  EXPECT_LE(d.rotation_rad, 4e-4);
}

TEST(AssembledPoses, DepartFromTheNonlinearSolutionTowardsFortyFiveDegrees) {
  // stated in docs/flank-contact.md; the bound only keeps the statement true
  const Difference d = largest_difference(45.0);
  RecordProperty("radial_um", std::to_string(d.radial_um));
  RecordProperty("tangential_um", std::to_string(d.tangential_um));
  RecordProperty("rotation_rad", std::to_string(d.rotation_rad));
  EXPECT_LE(d.radial_um, 2.5);
  EXPECT_LE(d.tangential_um, 0.7);
}

TEST(AssembledPoses, BetweenTeethPassesThroughTheTeeth) {
  const Gear gear = seed_gear();
  ResponseRequest request;
  request.flexspline = gear.flexspline;
  request.material = gear.material;
  request.mesh = gear.mesh;
  request.estimate = false;
  const UnitResponses responses = unit_responses(request).value();
  const RingCompliance ring(responses, {22.5, 24.5, 26.5}, true);
  const WaveGeneratorSurface discs(
      {.eccentricity_mm = 0.6, .neutral_disc_radius_mm = 13.606, .middle_z_mm = 24.5}, 13.856, 0.15);
  ContactSolver solver;
  const AssembledState assembled = assemble(ring, discs, 0.25, solver).value();
  const AssembledPoses poses(ring, assembled, 14.006, 0.25, {24.5});
  for (const int tooth : {-5, 0, 7}) {
    const double phi = 2.0 * std::numbers::pi * (tooth + 0.25) / 140.0;
    EXPECT_NEAR(poses.between(phi, 0).rho_mm, poses.pose(tooth, phi, 0).rho_mm, 1e-12);
  }
  // smooth between: half-way the interpolation from both sides of the mirror plane agrees
  EXPECT_NEAR(poses.between(0.02, 0).rho_mm, poses.between(-0.02, 0).rho_mm, 1e-6);
}

} // namespace
} // namespace strainwave
