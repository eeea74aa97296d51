// Rows of samples for whatever a gear file may choose, against the analysis of that gear.

#include "strainwave/model/forward/forward.hpp"
#include "tests/studies/tolerances/sampled_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace strainwave {
namespace {

struct Variant {
  const char* name;
  void (*change)(Gear&);
};

class SampledVariant : public ::testing::TestWithParam<Variant> {};

// Whatever the gear file chooses: a sample without errors is the analysis.
TEST_P(SampledVariant, ASampleWithoutErrorsIsTheAnalysis) {
  StudyFile study = study_with({error("pitch", SourceKind::adjacent_pitch, Normal{0.0, 1e-9}),
                                error("thick", SourceKind::tooth_thickness, Normal{0.0, 1e-9})});
  GetParam().change(study.gear);
  study.gear.load.torque_nm = {7.0};
  const auto gear = gear_of(study);
  const Rows rows = evaluate(*gear, std::vector<double>(gear->inputs(), 0.0));
  ASSERT_EQ(rows.status[0], row_ok) << rows.messages[0].text;
  ForwardModel model({.disk_cache = true});
  const ForwardResult exact = model.analyze(study.gear);
  ASSERT_EQ(exact.status, Status::ok) << exact.message;
  const LoadResult& load = exact.load[0];
  const bool listed_twice = std::ranges::any_of(load.phi_deg, [](double phi) { return phi > 90.0 + 1e-9; });
  const int lobes = study.gear.contact.lobes == 2 && !listed_twice ? 2 : 1;
  // One lobe alone tilts the cup, whose turning wall forces nearly push it over: the Newton steps that leave
  // 1e-11 mm of the wall's gap then end some 1e-7 mm from each other.
  const double tolerance = study.gear.contact.lobes == 2 ? 1e-7 : 1e-5;
  EXPECT_NEAR(rows(0, "rotation_rad"), load.rotation_rad, tolerance * load.rotation_rad);
  EXPECT_NEAR(rows(0, "peak_force_n"), load.peak_force_n, 10.0 * tolerance * load.peak_force_n);
  EXPECT_EQ(rows(0, "engaged_count_all"), lobes * load.engaged_count);
  EXPECT_NEAR(rows(0, "torque_nm"), 7.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    Gears, SampledVariant,
    ::testing::Values(Variant{"linear", [](Gear& g) { g.contact.fidelity = Fidelity::linear; }},
                      Variant{"linearised_gap", [](Gear& g) { g.contact.disc_gap = DiscGap::linearised; }},
                      Variant{"flank_normal",
                              [](Gear& g) { g.contact.force_direction = ForceDirection::flank_normal; }},
                      Variant{"assembled_gaps",
                              [](Gear& g) {
                                g.contact.gaps = GapModel::assembled;
                                g.circular_spline.profile_shift = 2.30;
                              }},
                      Variant{"reference_section",
                              [](Gear& g) {
                                g.contact.gaps = GapModel::assembled;
                                g.contact.reference_section_mm = 24.5;
                                g.circular_spline.profile_shift = 2.25;
                              }},
                      Variant{"window",
                              [](Gear& g) {
                                g.contact.window_deg = {-21.0, 51.0};
                              }},
                      Variant{"one_lobe", [](Gear& g) { g.contact.lobes = 1; }},
                      Variant{"ellipse",
                              [](Gear& g) {
                                g.wave_generator.shape = WaveGeneratorShape::ellipse;
                                g.wave_generator.eccentricity_mm.reset();
                                g.circular_spline.profile_shift = 2.4;
                              }},
                      Variant{"four_force",
                              [](Gear& g) {
                                g.wave_generator.shape = WaveGeneratorShape::four_force;
                                g.wave_generator.eccentricity_mm.reset();
                                g.wave_generator.force_angle_deg = 35.0;
                                g.contact.fidelity = Fidelity::linear;
                                g.circular_spline.profile_shift = 2.4;
                              }},
                      Variant{"odd_teeth",
                              [](Gear& g) {
                                g.flexspline.teeth = 139;
                                g.circular_spline.teeth = 141;
                                g.flexspline.tip_radius_mm -= 0.1;
                                g.flexspline.root_radius_mm -= 0.1;
                                g.flexspline.neutral_radius_mm -= 0.1;
                                g.circular_spline.tip_radius_mm -= 0.1;
                                g.circular_spline.root_radius_mm -= 0.1;
                              }}),
    [](const auto& variant) { return std::string(variant.param.name); });

} // namespace
} // namespace strainwave
