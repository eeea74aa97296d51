// Rows of samples against one gear at a time: its own assembly, direct geometry and Newton steps on the whole
// ring.

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/meshing/gear_surface.hpp"
#include "tests/studies/tolerances/sampled_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace strainwave {
namespace {

using units::pi;

/// One gear as it is, on the whole ring: discs by assembly and Newton steps, pitch errors [µm] put into the
/// direct geometry.
struct OneGear {
  double u0 = 0.2, e = 0.6, x2 = 2.19;
  std::span<const double> pitch1 = {}, pitch2 = {}; ///< of 140 teeth and 142 spaces, or none
  bool own_heights = false; ///< compliance at the contact heights of this gear, not at the nominal ones
};
struct Loaded {
  double rotation_rad = 0.0, peak_n = 0.0;
};
Loaded exact_load(const NominalMesh& nominal, const OneGear& one) {
  NominalMesh mesh = nominal;
  mesh.gear.wave_generator.max_radial_deformation_mm = one.u0;
  mesh.gear.wave_generator.eccentricity_mm = one.e;
  mesh.gear.circular_spline.profile_shift = one.x2;
  const Flexspline& fs = mesh.gear.flexspline;
  const NeutralCurve curve = NeutralCurve::make(mesh.gear.wave_generator, fs).value();
  mesh.surface = discs_of(mesh.gear, one.e, *curve.summary().disc_radius_mm);
  ContactSolver solver;
  mesh.assembled = assemble(*mesh.ring, mesh.surface, 0.0, solver).value();
  const FlankPair flanks = FlankPair::make(mesh.gear).value();
  for (LoadedPoint& tooth : mesh.teeth) {
    const bool second = tooth.phi_rad > 0.5 * pi + 1e-9;
    const double phi = tooth.phi_rad - (second ? pi : 0.0);
    double turn1 = 0.0, turn2 = 0.0;
    if (!one.pitch1.empty()) {
      turn1 = 1e-3 * one.pitch1[static_cast<std::size_t>((tooth.tooth + 140) % 140)] / 14.0;
      turn2 =
          1e-3 * one.pitch2[static_cast<std::size_t>((tooth.tooth + (second ? 1 : 0) + 142) % 142)] / 14.2;
    }
    const ToothBacklash contact = flanks.drive(curve.pose(phi + turn1), phi * 140.0 / 142.0 + turn2);
    tooth.backlash_mm = contact.backlash_mm;
    tooth.contact_radius_mm = contact.contact_radius_mm;
    if (one.own_heights)
      tooth.flank_radius_mm =
          fs.root_radius_mm + contact.flank_height * (fs.tip_radius_mm - fs.root_radius_mm);
  }
  const LoadTangent load = nominal_load(mesh, 7.0).value();
  return {load.state.rotation,
          load.state.force.head(static_cast<Eigen::Index>(mesh.teeth.size())).maxCoeff()};
}

TEST(SampledGear, DiscsAreRightToSecondOrder) {
  const StudyFile study =
      study_with({one_number("u0", "wave_generator.max_radial_deformation_mm", 0.2, 0.0005),
                  one_number("e", "wave_generator.eccentricity_mm", 0.6, 0.002)});
  const auto gear = gear_of(study);
  for (const double size : {1.0, 0.25}) {
    const std::vector<double> row{0.2 + 0.0016 * size, 0.6 - 0.006 * size};
    const Rows rows = evaluate(*gear, row);
    const Loaded exact = exact_load(gear->mesh(), {.u0 = row[0], .e = row[1]});
    const double rotation = rows(0, "rotation_rad") / exact.rotation_rad - 1.0;
    const double peak = rows(0, "peak_force_n") / exact.peak_n - 1.0;
    // measured: 1.4e-6 and 7e-5; 4e-7 and 1.1e-5. With the interpolant's kinks (0.003 µm) on top of the
    // second order.
    EXPECT_LT(std::abs(rotation), 1e-5 * size);
    EXPECT_LT(std::abs(peak), 3e-4 * size);
  }
}

// Pitch errors put into the direct geometry tooth by tooth, the whole ring solved by the forward model's own
// pieces.
TEST(SampledGear, ErrorsOfSingleTeethAreThoseOfTheDirectGeometry) {
  StudyFile study = teeth_study();
  study.part<MonteCarloPart>().sources.resize(2);
  const auto gear = gear_of(study);
  const std::vector<double> inputs = drawn(study, 5, 3);
  const Rows rows = evaluate(*gear, inputs);
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(rows.status[k], row_ok);
    const auto errors = std::span(inputs).subspan(k * gear->inputs(), gear->inputs());
    const Loaded exact =
        exact_load(gear->mesh(), {.pitch1 = errors.first(140), .pitch2 = errors.subspan(140, 142)});
    EXPECT_NEAR(rows(k, "rotation_rad"), exact.rotation_rad, 3e-5 * exact.rotation_rad);
    EXPECT_NEAR(rows(k, "peak_force_n"), exact.peak_n, 1e-3 * exact.peak_n);
  }
}

// Everything at once, as in the gallery: random gears against their own assembly, direct geometry and Newton
// steps.
TEST(SampledGearNightly, RandomGearsAreTheirOwnExactSolutions) {
  StudyFile study = teeth_study();
  study.part<MonteCarloPart>().sources.resize(2);
  study.part<MonteCarloPart>().sources.push_back(
      one_number("u0", "wave_generator.max_radial_deformation_mm", 0.2, 0.0005));
  study.part<MonteCarloPart>().sources.push_back(
      one_number("e", "wave_generator.eccentricity_mm", 0.6, 0.002));
  study.part<MonteCarloPart>().sources.push_back(
      one_number("x2", "circular_spline.profile_shift", 2.19, 0.005));
  const auto gear = gear_of(study);
  constexpr std::size_t samples = 48;
  const std::vector<double> inputs = drawn(study, 0, samples);
  const Rows rows = evaluate(*gear, inputs);
  const auto& sources = gear->sources().sources();
  double rotation[2] = {}, peak[2] = {};
  for (std::size_t k = 0; k < samples; ++k) {
    ASSERT_EQ(rows.status[k], row_ok) << rows.messages[0].text;
    const auto row = std::span(inputs).subspan(k * gear->inputs(), gear->inputs());
    for (const bool own : {false, true}) {
      const Loaded exact = exact_load(gear->mesh(), {.u0 = row[sources[2].first],
                                                     .e = row[sources[3].first],
                                                     .x2 = row[sources[4].first],
                                                     .pitch1 = row.subspan(sources[0].first, 140),
                                                     .pitch2 = row.subspan(sources[1].first, 142),
                                                     .own_heights = own});
      rotation[own] = std::max(rotation[own], std::abs(rows(k, "rotation_rad") / exact.rotation_rad - 1.0));
      peak[own] = std::max(peak[own], std::abs(rows(k, "peak_force_n") / exact.peak_n - 1.0));
    }
  }
  // measured: 5.5e-6 and 1.6e-4; with own heights 7e-5 and 2.8e-3
  EXPECT_LT(rotation[0], 3e-5);
  EXPECT_LT(peak[0], 5e-4);
  EXPECT_LT(rotation[1], 2e-4); // contact heights move with u0
  EXPECT_LT(peak[1], 1e-2);
}

} // namespace
} // namespace strainwave
