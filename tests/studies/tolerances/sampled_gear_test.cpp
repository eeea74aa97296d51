// Rows of samples against the forward model on the gear that a row describes, and against direct geometry and
// the general solver for errors of single teeth.

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/forward/forward.hpp"

#include "strainwave/studies/tolerances/monte_carlo.hpp"
#include "tests/studies/tolerances/sampled_rows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strainwave {
namespace {

using units::pi;

double least(const std::vector<double>& values) {
  double found = 1e300;
  for (const double v : values)
    if (!std::isnan(v))
      found = std::min(found, v);
  return found;
}

TEST(SampledGear, OtherDiscsClearanceAndTorqueAreTheForwardModelsGears) {
  const StudyFile study =
      study_with({one_number("u0", "wave_generator.max_radial_deformation_mm", 0.2, 0.0005),
                  one_number("e", "wave_generator.eccentricity_mm", 0.6, 0.002),
                  one_number("x2", "circular_spline.profile_shift", 2.19, 0.01),
                  one_number("torque", "load_case[0].torque_nm", 7.0, 0.5)});
  const auto gear = gear_of(study);
  ASSERT_TRUE(gear->discs());
  EXPECT_LT(gear->discs()->error_mm(), 5e-5);
  const auto& sources = gear->sources().sources();
  const std::vector<std::array<double, 4>> samples{{0.2, 0.6, 2.19, 7.0},       {0.2007, 0.6, 2.19, 7.0},
                                                   {0.2, 0.597, 2.19, 7.0},     {0.1992, 0.603, 2.20, 7.5},
                                                   {0.2004, 0.598, 2.175, 6.0}, {0.203, 0.6, 2.21, 7.0}};
  ForwardModel model({.disk_cache = true});
  for (const auto& sample : samples) {
    std::vector<double> row(gear->inputs());
    for (std::size_t k = 0; k < sample.size(); ++k)
      row[sources[k].first] = sample[k];
    const Rows rows = evaluate(*gear, row);
    ASSERT_EQ(rows.status[0], row_ok) << rows.messages[0].text;
    Gear direct = study.gear;
    direct.wave_generator.max_radial_deformation_mm = sample[0];
    direct.wave_generator.eccentricity_mm = sample[1];
    direct.circular_spline.profile_shift = sample[2];
    direct.load.torque_nm = {sample[3]};
    const ForwardResult exact = model.analyze(direct);
    ASSERT_EQ(exact.status, Status::ok) << exact.message;
    const LoadResult& load = exact.load[0];
    // Rows keep the compliance of the nominal contact heights, which move with u0: 0.5 % of the peak for a
    // micrometre.
    const double moved_um = 1e3 * std::abs(sample[0] - 0.2);
    EXPECT_NEAR(rows(0, "rotation_rad"), load.rotation_rad, (1e-5 + 1e-4 * moved_um) * load.rotation_rad);
    EXPECT_NEAR(rows(0, "peak_force_n"), load.peak_force_n, (1e-5 + 6e-3 * moved_um) * load.peak_force_n);
    EXPECT_EQ(rows(0, "engaged_count_all"), 2 * load.engaged_count);
    EXPECT_NEAR(rows(0, "min_tooth_backlash_um"), least(exact.backlash->backlash_um), 1e-3);
    EXPECT_NEAR(rows(0, "lobe_share"), 0.5, 1e-9);
  }
}

TEST(SampledGear, OneNameHasOneMeaning) {
  std::size_t shared = 0;
  for (const Response& sampled : sampled_responses()) {
    const auto analysed = find_response(gear_responses(), sampled.name);
    if (!analysed)
      continue;
    ++shared;
    EXPECT_EQ(sampled.unit, gear_responses()[*analysed].unit) << sampled.name;
    EXPECT_EQ(sampled.sentence, gear_responses()[*analysed].sentence) << sampled.name;
  }
  EXPECT_GE(shared, 6u);
  for (const auto& counterpart : sampled_counterparts()) {
    EXPECT_TRUE(find_response(gear_responses(), counterpart.name)) << counterpart.name;
    EXPECT_FALSE(find_response(sampled_responses(), counterpart.name)) << counterpart.name;
  }
}

TEST(SampledGear, RowsDoNotDependOnTheirNeighboursOrTheWorker) {
  const StudyFile study = teeth_study();
  const auto gear = gear_of(study);
  const std::vector<double> inputs = drawn(study, 0, 16);
  const Rows together = evaluate(*gear, inputs);
  const std::size_t n = gear->inputs();
  for (std::size_t k = 16; k-- > 0;) {
    const Rows alone = evaluate(*gear, std::span(inputs).subspan(k * n, n));
    for (std::size_t c = 0; c < together.width; ++c)
      EXPECT_EQ(together.outputs[k * together.width + c], alone.outputs[c]);
  }
  std::vector<double> one(n);
  const SampledStudy rows = make_monte_carlo_rows(study, cup_cache()).value();
  rows.inputs(7, 1, one);
  EXPECT_TRUE(std::equal(one.begin(), one.end(), inputs.begin() + static_cast<std::ptrdiff_t>(7 * n)));
}

TEST(SampledGear, WorstPositionIsTheWorstOfItsPositions) {
  const StudyFile study = teeth_study();
  const auto four = gear_of(study, 4), one = gear_of(study);
  const std::vector<double> inputs = drawn(study, 0, 4);
  const Rows worst = evaluate(*four, inputs), first = evaluate(*one, inputs);
  bool elsewhere = false;
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GE(worst(k, "peak_force_n"), first(k, "peak_force_n"));
    EXPECT_LE(worst(k, "min_tooth_backlash_um"), first(k, "min_tooth_backlash_um"));
    EXPECT_LE(worst(k, "engaged_count_all"), first(k, "engaged_count_all"));
    elsewhere = elsewhere || worst(k, "peak_force_n") > first(k, "peak_force_n");
  }
  EXPECT_TRUE(elsewhere);
  // position 35 by hand: the errors of tooth i + 35 stand at tooth i
  std::vector<double> turned(inputs.begin(), inputs.begin() + static_cast<std::ptrdiff_t>(one->inputs()));
  const auto& sources = one->sources().sources();
  std::rotate(turned.begin(), turned.begin() + 35, turned.begin() + 140);
  std::rotate(turned.begin() + 140, turned.begin() + 175, turned.begin() + 282);
  const double around = 2.0 * pi * 35.0 / 140.0, space = 2.0 * pi * 35.0 / 142.0;
  turned[sources[2].first + 1] -= around;
  const double x = turned[sources[3].first], y = turned[sources[3].first + 1];
  turned[sources[3].first] = x * std::cos(space) + y * std::sin(space);
  turned[sources[3].first + 1] = y * std::cos(space) - x * std::sin(space);
  const Rows by_hand = evaluate(*one, turned);
  EXPECT_GE(worst(0, "peak_force_n"), by_hand(0, "peak_force_n") * (1.0 - 1e-9));
  EXPECT_LE(worst(0, "min_tooth_backlash_um"), by_hand(0, "min_tooth_backlash_um") + 1e-9);
}

TEST(SampledGear, ACoastFlankThatTouchesIsNoResult) {
  const StudyFile study = study_with({error("thick", SourceKind::tooth_thickness, Normal{0.0, 1.0})});
  const auto gear = gear_of(study);
  const std::vector<double> rows{0.0, 60.0}; // µm thicker: far more than the whole clearance
  const Rows result = evaluate(*gear, rows);
  EXPECT_EQ(result.status[0], row_ok);
  ASSERT_EQ(result.status[1], row_coast_contact);
  EXPECT_EQ(gear->status_name(row_coast_contact), "coast_contact");
  ASSERT_EQ(result.messages.size(), 1u);
  EXPECT_NE(result.messages[0].text.find("coast flank"), std::string::npos);
}

TEST(SampledGear, DiscsThatCannotBeAreFailedRowsAndWideSourcesKeepASmallerBox) {
  const StudyFile study =
      study_with({one_number("u0", "wave_generator.max_radial_deformation_mm", 0.2, 0.004),
                  one_number("e", "wave_generator.eccentricity_mm", 0.6, 0.01)});
  const auto gear = gear_of(study); // 4.3 standard deviations of both would leave e/u0 > 2.752
  ASSERT_TRUE(gear->discs());
  EXPECT_FALSE(gear->discs()->contains(0.217, 0.6));
  const std::vector<double> inputs{0.2, 0.6, 0.23, 0.6};
  const Rows rows = evaluate(*gear, inputs);
  EXPECT_EQ(rows.status[0], row_ok);
  ASSERT_EQ(rows.status[1], row_status_of(Status::no_wrap));
  EXPECT_NE(rows.messages[0].text.find("e/u0"), std::string::npos);
}

TEST(SampledGear, CorrelatedSourcesStandSideBySideAndAreCorrelated) {
  StudyFile study = study_with({one_number("torque", "load_case[0].torque_nm", 7.0, 0.1),
                                error("teeth", SourceKind::adjacent_pitch, Normal{0.0, 0.2}),
                                one_number("x2", "circular_spline.profile_shift", 2.19, 0.002),
                                error("thick", SourceKind::tooth_thickness, Normal{0.0, 0.5})});
  study.part<MonteCarloPart>().correlations = {{"thick", "torque", 0.8}};
  study.part<MonteCarloPart>().sampling.samples = 4096;
  const SampledStudy rows = make_monte_carlo_rows(study, cup_cache()).value();
  ASSERT_EQ(rows.input_columns.size(), 4u);
  EXPECT_EQ(rows.input_columns[0].unit, "N.m");
  EXPECT_EQ(rows.input_columns[3].unit, "um");
  std::vector<double> named(4 * 4096);
  rows.input_values(0, 4096, named);
  double a = 0.0, b = 0.0, spread = 0.0;
  for (std::size_t k = 0; k < 4096; ++k) {
    a += (named[4 * k] - 7.0) / 0.1 * named[4 * k + 3] / 0.5 / 4096;
    b += (named[4 * k + 2] - 2.19) / 0.002 * named[4 * k + 3] / 0.5 / 4096;
    spread += named[4 * k + 1] / 4096;
  }
  EXPECT_NEAR(a, 2.0 * std::sin(pi / 6.0 * 0.8),
              5.0 / std::sqrt(4096.0)); // Pearson's of a normal pair with this rank
  EXPECT_NEAR(b, 0.0, 5.0 / std::sqrt(4096.0));
  EXPECT_NEAR(spread, 0.2, 0.002); // root mean square of 140
}

TEST(SampledGear, ARowIsDescribedWithAllItsTeeth) {
  const StudyFile study = teeth_study();
  const SampledStudy rows = make_monte_carlo_rows(study, cup_cache()).value();
  const auto gear = gear_of(study);
  const std::vector<double> inputs = drawn(study, 3, 1);
  const Rows known = evaluate(*gear, inputs);
  const auto json = nlohmann::json::parse(rows.describe_row(3));
  EXPECT_EQ(json["row"], 3);
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["sources"]["flexspline"].size(), 140u);
  EXPECT_EQ(json["sources"]["circular spline"][141].get<double>(), inputs[281]);
  const auto& load = json["loads"][0][0];
  double torque = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < load["force_n"].size(); ++i) {
    torque += load["force_n"][i].get<double>() * load["contact_radius_mm"][i].get<double>();
    peak = std::max(peak, load["force_n"][i].get<double>());
  }
  EXPECT_NEAR(torque, 7000.0, 1e-6);
  EXPECT_EQ(peak, known(0, "peak_force_n"));
  EXPECT_EQ(json["outputs"]["rotation_rad"].get<double>(), known(0, "rotation_rad"));
}

std::string refused(const StudyFile& study) {
  try {
    (void)make_monte_carlo_rows(study, cup_cache());
  } catch (const FieldError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SampledGear, RefusesWhatSamplesCannotHave) {
  EXPECT_NE(
      refused(study_with({one_number("t", "flexspline.rim_thickness_mm", 0.3, 0.01)})).find("share one cup"),
      std::string::npos);
  EXPECT_NE(refused(study_with({one_number("t", "load_case[1].torque_nm", 7.0, 0.01)})).find("load case 1"),
            std::string::npos);
  StudyFile coast = teeth_study();
  coast.load_cases[0].direction = Direction::coast;
  EXPECT_NE(refused(coast).find("drive direction"), std::string::npos);
  StudyFile points = teeth_study();
  points.gear.contact.flank_points = 4;
  const auto failure = make_monte_carlo_rows(points, cup_cache());
  ASSERT_FALSE(failure.ok());
  EXPECT_EQ(failure.failure().status, Status::not_available);
}

} // namespace
} // namespace strainwave
