// A study of kind "optimize" from the file to the judged optimum.

#include "strainwave/common/files/content_hash.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/studies/commands/kinds.hpp"
#include "strainwave/studies/file/study_gear.hpp"
#include "strainwave/studies/search/optimisation.hpp"
#include "strainwave/studies/search/results_file.hpp"
#include "strainwave/studies/search/text.hpp"
#include "tests/studies/studies.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace strainwave {
namespace {

/// Root relief and u0, on a coarse cup without a disk cache.
const std::string coarse_study = R"(kind = "optimize"
gear = "seed.toml"
[override]
mesh = { per_pitch = 3, along_face = 4, along_wall = 5, diaphragm = 3, tooth_height = 2 }
[[load_case]]
torque_nm = 7.0
[[variable]]
path = "flank_modification.flexspline.root_relief_um"
lower = 0.0
upper = 12.0
start = 3.0
[[variable]]
path = "wave_generator.max_radial_deformation_mm"
lower = 0.19
upper = 0.21
link = { path = "wave_generator.eccentricity_mm", ratio = 3.0 }
[objective]
output = "peak_force_n"
[[constraint]]
output = "secant_nm_per_rad"
min_ratio_to_baseline = 0.95
[method]
name = "cobyla"
budget = 160
tolerance = 1e-3
)";

double value(const Evaluation& evaluation, std::string_view name) {
  return evaluation.values[*find_response(gear_responses(), name)];
}

class CoarseStudy : public testing::Test {
protected:
  StudyFolder folder;
  RunOptions options{.context = {.threads = 1, .disk_cache = false}};

  Outcome<OptimisationReport> run(const std::string& text) {
    return run_optimisation(folder.read(text), options);
  }
};

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t place = text.find(old);
  EXPECT_NE(place, std::string::npos) << old;
  return text.replace(place, old.size(), replacement);
}

TEST_F(CoarseStudy, LowersThePeakForceAndKeepsTheStiffness) {
  const auto report = run(coarse_study);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->verdict, Verdict::converged) << report->message;
  EXPECT_LT(value(*report->best, "peak_force_n"), 0.995 * value(report->baseline, "peak_force_n"));
  EXPECT_GE(value(*report->best, "secant_nm_per_rad"),
            0.95 * value(report->baseline, "secant_nm_per_rad") * (1 - 1e-6));
  EXPECT_EQ(report->counts.failed, 0u);
  EXPECT_TRUE(report->certificate_worst.holds());
}

TEST_F(CoarseStudy, ShowsTheOptimumInOtherModelsAndBesideItsBound) {
  const auto report = run(coarse_study);
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(report->variants.size(), 4u);
  const auto& own = report->variants.front();
  EXPECT_EQ(value(own.best, "peak_force_n"), value(*report->best, "peak_force_n"));
  EXPECT_EQ(value(own.baseline, "peak_force_n"), value(report->baseline, "peak_force_n"));
  // a wall that may not lift off is stiffer, and more phases cannot lower the worst force
  EXPECT_LT(value(report->variants[1].best, "rotation_rad"), value(own.best, "rotation_rad"));
  EXPECT_EQ(report->variants[2].name, "assembled gaps");
  EXPECT_GE(value(report->variants[3].best, "peak_force_n"), value(own.best, "peak_force_n"));
  ASSERT_TRUE(report->bound) << report->no_bound;
  EXPECT_LT(report->bound->bound.peak_force_n, value(*report->best, "peak_force_n"));
  EXPECT_EQ(report->bound->bound.rotation_rad, value(*report->best, "rotation_rad")); // no limit on it
  EXPECT_GT(report->bound->bound.peak_force_n,
            10.0); // 7 N·m over every tooth within reach of a lobe: some 8 N
}

TEST_F(CoarseStudy, ThreadsDoNotShowInTheResult) {
  const StudyFile study = folder.read(with(coarse_study, "budget = 160", "budget = 120\nstarts = 3"));
  const auto one = run_optimisation(study, options);
  options.context.threads = 2;
  const auto two = run_optimisation(study, options);
  EXPECT_EQ(one->inputs[0].best, two->inputs[0].best);
  EXPECT_EQ(one->best->values[0], two->best->values[0]);
  ASSERT_EQ(one->points.size(), two->points.size());
  for (std::size_t i = 0; i < one->points.size(); ++i)
    EXPECT_EQ(one->points[i].x, two->points[i].x);
}

TEST_F(CoarseStudy, ImpossibleLimitIsInfeasibleWithItsViolation) {
  const auto report = run(with(coarse_study, "min_ratio_to_baseline = 0.95", "min_ratio_to_baseline = 2"));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->verdict, Verdict::infeasible);
  EXPECT_TRUE(report->best_gear);
  EXPECT_NE(report->message.find("secant_nm_per_rad is "), std::string::npos) << report->message;
}

TEST_F(CoarseStudy, InterferingGearIsNoBaseline) {
  const auto report =
      run(with(coarse_study, "[override]\n", "[override]\ncircular_spline.profile_shift = 2.13\n"));
  ASSERT_FALSE(report.ok());
  EXPECT_NE(report.failure().message.find("raise circular_spline.profile_shift"), std::string::npos);
}

TEST_F(CoarseStudy, StopIsHeeded) {
  int asked = 0;
  options.context.stop = [&] { return ++asked > 5; };
  const auto report = run(coarse_study);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->verdict, Verdict::stopped);
  EXPECT_EQ(report->points.size(), 5u);
}

TEST_F(CoarseStudy, FolderHoldsTheOptimisedGearAndEveryEvaluation) {
  const auto report = run(coarse_study);
  ASSERT_TRUE(report.ok());
  const ResultFolder results(folder.path("out"));
  results.write_plan(report->study);
  write_search_results(results, *report);
  const Gear gear = load_gear(folder.path("out/best.toml")).gear;
  EXPECT_EQ(canonical_bits(gear), canonical_bits(*report->best_gear));
  EXPECT_EQ(gear.flank_modification.flexspline.root_relief_um, report->inputs[0].best);

  const hid_t file = H5Fopen(folder.path("out/results.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  hsize_t shape[2] = {};
  H5LTget_dataset_info(file, "outputs", shape, nullptr, nullptr);
  EXPECT_EQ(shape[0], report->points.size());
  EXPECT_EQ(shape[1], gear_responses().size());
  std::vector<double> inputs(report->points.size() * report->study.part<SearchPart>().variables.size());
  H5LTread_dataset_double(file, "inputs", inputs.data());
  EXPECT_EQ(inputs[0], report->points[0].x[0]);
  H5Fclose(file);

  std::ifstream plan(folder.path("out/plan.json"));
  EXPECT_EQ(nlohmann::json::parse(plan)["hash"], hash_text(plan_hash(report->study)));
}

TEST_F(CoarseStudy, JsonHasTheKeysOfTheInterface) {
  const auto report = run(coarse_study);
  const auto json = optimisation_json(*report, "out");
  for (const char* key :
       {"kind", "verdict", "evaluations", "seconds", "best", "baseline", "certificate_worst", "folder"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["best"]["inputs"]["flank_modification.flexspline.root_relief_um"], report->inputs[0].best);
  EXPECT_EQ(json["baseline"]["inputs"]["flank_modification.flexspline.root_relief_um"], 0.0);
  EXPECT_EQ(json["evaluations"]["failed"], 0);
  EXPECT_TRUE(json["best"]["outputs"]["transmission_error_arcsec"].is_null()); // one phase
}

TEST_F(CoarseStudy, ParetoStudyGivesAFrontThatFallsInOneAimAndRisesInTheOther) {
  std::string text = with(coarse_study, "\"optimize\"", "\"pareto\"");
  text = with(text, "[method]\nname = \"cobyla\"\nbudget = 160",
              "[pareto]\noutput = \"rotation_rad\"\npoints = 3\n[method]\nname = \"cobyla\"\nbudget = 250");
  const auto report = run(text);
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(report->front.size(), 3u);
  for (std::size_t j = 0; j + 1 < report->front.size(); ++j) {
    const Evaluation& a = *report->front[j].outputs;
    const Evaluation& b = *report->front[j + 1].outputs;
    EXPECT_LE(value(a, "peak_force_n"), value(b, "peak_force_n") * (1 + 1e-3));
    EXPECT_GE(value(a, "rotation_rad"), value(b, "rotation_rad") * (1 - 1e-6));
    EXPECT_LE(value(b, "rotation_rad"), *report->front[j + 1].bound * (1 + 1e-6));
  }
  EXPECT_EQ(optimisation_json(*report, "out")["front"].size(), 3u);
}

TEST_F(CoarseStudy, ParetoStudyWithoutASecondAimIsRefused) {
  EXPECT_NE(folder.complaint(with(coarse_study, "\"optimize\"", "\"pareto\""))
                .find("the table [pareto] is missing"),
            std::string::npos);
  EXPECT_NE(folder.complaint(coarse_study + "[pareto]\noutput = \"rotation_rad\"\n").find("of no use"),
            std::string::npos);
}

TEST(StudyLoads, CasesWithTheSamePhasesShareAnAnalysis) {
  StudyFile study;
  study.gear = seed_gear();
  study.load_cases = {{.torque_nm = 1.0, .rotation_rad = {}, .phases = 4},
                      {.torque_nm = 7.0, .rotation_rad = {}, .phases = 4},
                      {.torque_nm = {}, .rotation_rad = 3e-3, .phases = 1}};
  const auto loads = study_loads(study);
  ASSERT_EQ(loads.size(), 2u);
  EXPECT_EQ(loads[0].torque_nm, (std::vector{1.0, 7.0}));
  EXPECT_EQ(loads[1].rotation_rad, (std::vector{3e-3}));
  EXPECT_EQ(loads[1].rated_torque_nm, 7.0);
}

TEST(StudyDesign, StartsAtTheGearMovedIntoTheBounds) {
  StudyFile study(optimize_kind());
  study.gear = seed_gear();
  study.part<SearchPart>().variables = {{.path = "circular_spline.profile_shift",
                                         .lower = 2.2,
                                         .upper = 2.3,
                                         .start = {},
                                         .scale = {},
                                         .link = {}}};
  EXPECT_EQ(study_design(study).start(), (std::vector{2.2}));
}

/// The gallery's study, small version, on the gear as it is. The number is this program's own (mesh of the
/// seed gear).
TEST(GalleryStudy, WholeFlankOptimaAreFarBelowTheUnmodifiedGear) {
  for (const auto& [name, gain] : {std::pair{"seed_optimize", 0.2}, {"seed_optimize_coned", 0.3}}) {
    const StudyFile study =
        load_study(std::string(STRAINWAVE_SOURCE "/studies/gallery/") + name + ".toml", study_kinds(), true);
    const auto report = run_optimisation(study, {});
    ASSERT_TRUE(report.ok());
    ASSERT_TRUE(report->best);
    EXPECT_LT(value(*report->best, "peak_force_n"), (1 - gain) * value(report->baseline, "peak_force_n"))
        << name;
    EXPECT_LE(value(*report->best, "rotation_rad"),
              1.05 * value(report->baseline, "rotation_rad") * (1 + 1e-6));
    EXPECT_GE(value(*report->best, "min_backlash_um"), 1.0 - 1e-6);
    EXPECT_TRUE(report->best->certificate.holds());
  }
}

TEST(GalleryStudy, SeedOptimizeReducedFindsTheKnownOptimum) {
  const StudyFile study =
      load_study(STRAINWAVE_SOURCE "/studies/gallery/seed_optimize_one_point.toml", study_kinds(), true);
  const auto report = run_optimisation(study, {});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->verdict, Verdict::converged) << report->message;
  EXPECT_NEAR(value(report->baseline, "peak_force_n"), 47.186, 0.005);
  EXPECT_NEAR(value(*report->best, "peak_force_n"), 42.17, 0.05); // 1e-3 of the baseline, the tolerance
}

} // namespace
} // namespace strainwave
