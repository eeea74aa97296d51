// Study files that are right: what is read is what stands there.

#include "tests/studies/studies.hpp"

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/studies/search/search.hpp"

namespace strainwave {
namespace {

TEST(StudyFileRead, EveryKeyArrives) {
  const StudyFolder folder;
  const StudyFile study = folder.read(good_study);
  EXPECT_EQ(study.gear_file, folder.path("seed.toml"));
  EXPECT_EQ(study.seed, 7);
  ASSERT_EQ(study.load_cases.size(), 2u);
  EXPECT_EQ(study.load_cases[0].torque_nm, 7.0);
  EXPECT_EQ(study.load_cases[0].phases, 4);
  EXPECT_EQ(study.load_cases[1].rotation_rad, 3e-3);
  EXPECT_EQ(study.load_cases[1].direction, Direction::both);
  ASSERT_EQ(study.part<SearchPart>().variables.size(), 3u);
  EXPECT_EQ(study.part<SearchPart>().variables[0].path, "flank_modification.flexspline.tip_relief_um");
  EXPECT_EQ(study.part<SearchPart>().variables[0].upper, 15.0);
  EXPECT_EQ(study.part<SearchPart>().variables[0].start, 5.0);
  EXPECT_EQ(study.part<SearchPart>().variables[0].scale, 10.0);
  ASSERT_TRUE(study.part<SearchPart>().variables[1].link);
  EXPECT_EQ(study.part<SearchPart>().variables[1].link->path, "wave_generator.eccentricity_mm");
  EXPECT_EQ(study.part<SearchPart>().variables[1].link->ratio, 3.0);
  EXPECT_FALSE(study.part<SearchPart>().variables[1].start);
  EXPECT_EQ(study.part<SearchPart>().objective.output, "peak_force_n");
  EXPECT_EQ(study.part<SearchPart>().objective.goal, Goal::minimise);
  ASSERT_EQ(study.part<SearchPart>().constraints.size(), 2u);
  EXPECT_EQ(study.part<SearchPart>().constraints[0].max_ratio_to_baseline, 1.05);
  EXPECT_EQ(study.part<SearchPart>().constraints[1].min, 3000.0);
  EXPECT_EQ(study.part<SearchPart>().method.name, "cobyla");
  EXPECT_EQ(study.part<SearchPart>().method.budget, 150);
  EXPECT_EQ(study.part<SearchPart>().method.tolerance, 1e-5);
  EXPECT_EQ(study.part<SearchPart>().method.starts, 2);
  EXPECT_EQ(study.limits.failure_share, 0.02);
}

TEST(StudyFileRead, TheGearIsTheBaselineWithItsOverrides) {
  const StudyFolder folder;
  Gear expected = seed_gear();
  expected.wave_generator.shape = WaveGeneratorShape::two_disc;
  expected.load.rated_torque_nm = 8.0;
  expected.flank_modification.flexspline.spline_um = {0.0, 0.0, 0.0, 1.0};
  EXPECT_EQ(canonical_bits(folder.read(good_study).gear), canonical_bits(expected));
}

TEST(StudyFileRead, ReducedChangesTheStudyAndTheGear) {
  const StudyFolder folder;
  const StudyFile whole = folder.read(good_study), reduced = folder.read(good_study, true);
  EXPECT_EQ(whole.part<SearchPart>().method.budget, 150);
  EXPECT_EQ(whole.load_cases[0].phases, 4);
  EXPECT_EQ(whole.gear.mesh.per_pitch, seed_gear().mesh.per_pitch);
  EXPECT_EQ(reduced.part<SearchPart>().method.budget, 10);
  EXPECT_EQ(reduced.load_cases[0].phases, 1);
  EXPECT_EQ(reduced.gear.mesh.per_pitch, 3);
}

TEST(StudyFileRead, LoadsComeFromTheGearWhereNoneAreGiven) {
  const StudyFolder folder;
  const StudyFile study =
      folder.read("kind = \"optimize\"\ngear = \"seed.toml\"\n[override]\nload.rotation_rad = [1e-3]\n"
                  "load.phases = 3\n[[variable]]\npath = \"circular_spline.profile_shift\"\n"
                  "lower = 2.1\nupper = 2.3\n[objective]\noutput = \"peak_force_n\"\n");
  ASSERT_EQ(study.load_cases.size(), 4u);
  EXPECT_EQ(study.load_cases[1].torque_nm, 7.0);
  EXPECT_EQ(study.load_cases[3].rotation_rad, 1e-3);
  EXPECT_EQ(study.load_cases[3].phases, 3);
  EXPECT_EQ(study.part<SearchPart>().method.budget, StudyMethod{}.budget);
}

TEST(StudyFileRead, LoadsFromDisk) {
  const StudyFolder folder;
  EXPECT_EQ(
      load_study(folder.write("study.toml", good_study), study_kinds()).part<SearchPart>().variables.size(),
      3u);
}

TEST(StudyFileRead, OnlyTheKindsThatAreHandedInExist) {
  const StudyFolder folder;
  const std::vector<const StudyKind*> kinds{&optimize_kind()};
  EXPECT_EQ(parse_study(good_study, folder.path("study.toml"), kinds).kind, &optimize_kind());
  EXPECT_THROW(
      parse_study(edited(good_study, "\"optimize\"", "\"pareto\""), folder.path("study.toml"), kinds),
      FileError);
}

TEST(StudyFileRead, StudiesAndGearsAreToldApart) {
  EXPECT_TRUE(is_study_text(good_study, study_kinds()));
  EXPECT_TRUE(is_study_text("gear = \"x\"\n", study_kinds()));
  EXPECT_FALSE(is_study_text(file_text(seed_path), study_kinds()));
  EXPECT_FALSE(is_study_text("= =", study_kinds()));
}

TEST(StudyFileWrite, ReadsBackToTheSameStudy) {
  const StudyFolder folder;
  for (const bool reduced : {false, true}) {
    const StudyFile study = folder.read(good_study, reduced);
    const std::string text = write_study(study);
    const StudyFile back = folder.read(text);
    EXPECT_EQ(write_study(back), text);
    EXPECT_EQ(canonical_bits(back.gear), canonical_bits(study.gear));
    EXPECT_EQ(back.part<SearchPart>().method.budget, study.part<SearchPart>().method.budget);
    EXPECT_EQ(back.part<SearchPart>().variables[1].link->path,
              study.part<SearchPart>().variables[1].link->path);
    EXPECT_EQ(back.load_cases[0].phases, study.load_cases[0].phases);
    EXPECT_EQ(back.load_cases[1].direction, Direction::both);
  }
}

TEST(StudyFileWrite, ReducedChangesSurvive) {
  const StudyFolder folder;
  const std::string text = write_study(folder.read(good_study));
  EXPECT_EQ(folder.read(text, true).part<SearchPart>().method.budget, 10);
  EXPECT_EQ(folder.read(text, true).gear.mesh.per_pitch, 3);
}

} // namespace
} // namespace strainwave
