// Sweeps as a program: what comes out, and that it is the same bits however it was run.

#include "tests/studies/study_shell.hpp"

#include <cmath>

namespace strainwave {
namespace {

class SweepCommand : public StudyShell {};

TEST_F(SweepCommand, ARowIsTheGearThatAnalyzeComputes) {
  write_sweep();
  const End run = shell("PROGRAM study run sweep.toml --out a --json");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.json()["complete"], true);
  EXPECT_EQ(run.json()["evaluations"]["done"], 64);
  const End row = shell("PROGRAM eval --from a --index 37 --json --gear row.toml");
  ASSERT_EQ(row.code, 0) << row.err;
  EXPECT_EQ(row.json()["same_as_recorded"], true);
  // loads move fastest: row 37 = 16 · 2 + 5
  EXPECT_EQ(row.json()["inputs"]["flank_modification.flexspline.tip_relief_um"], 4.0);
  EXPECT_EQ(row.json()["inputs"]["load_case[0].torque_nm"], 3.0);
  const End analysis = shell("PROGRAM analyze row.toml --json");
  ASSERT_EQ(analysis.code, 0) << analysis.err;
  EXPECT_NEAR(analysis.json()["load"][0]["torque_nm"].get<double>(), 3.0, 1e-12);
  EXPECT_EQ(analysis.json()["load"][0]["peak_force_n"], row.json()["outputs"]["peak_force_n"]);
  EXPECT_EQ(analysis.json()["backlash"]["min_um"], row.json()["outputs"]["min_backlash_um"]);
}

TEST_F(SweepCommand, ThreadsAndShardsGiveTheSameBits) {
  write_sweep();
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out one --threads 1").code, 0);
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out two --threads 2").code, 0);
  EXPECT_TRUE(identical("one", "two"));
  for (const int shards : {3, 64}) { // of 64 shards most own no block
    const std::string out = fmt::format("of{}", shards);
    ASSERT_EQ(
        shell(fmt::format(
                  "for i in $(seq 0 {}); do PROGRAM study run sweep.toml --out {} --shard $i/{} || exit 9; "
                  "done; PROGRAM study merge {}",
                  shards - 1, out, shards, out))
            .code,
        0);
    EXPECT_TRUE(identical("one", out)) << shards;
  }
}

TEST_F(SweepCommand, StoppedByTimeGoesOnWhereItWas) {
  write_sweep();
  const End stopped = shell("PROGRAM study run sweep.toml --out a --threads 1 --time-limit 0.05 --json");
  ASSERT_EQ(stopped.code, 75) << stopped.err;
  EXPECT_EQ(stopped.json()["complete"], false);
  EXPECT_NE(stopped.err.find("run again to go on"), std::string::npos) << stopped.err;
  const End status = shell("PROGRAM study status a");
  EXPECT_NE(status.out.find("--shard 0/1"), std::string::npos) << status.out;
  EXPECT_EQ(shell("PROGRAM study run sweep.toml --out a").code, 0);
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out b").code, 0);
  EXPECT_TRUE(identical("a", "b"));
  const End again = shell("PROGRAM study run sweep.toml --out a --json");
  EXPECT_EQ(again.json()["evaluations"]["done"], 0);
  EXPECT_EQ(again.json()["evaluations"]["reused"], 64);
}

TEST_F(SweepCommand, MergeNamesTheShardThatIsMissing) {
  write_sweep();
  for (const int shard : {0, 2})
    ASSERT_EQ(shell(fmt::format("PROGRAM study run sweep.toml --out a --shard {}/3", shard)).code, 0);
  const End gap = shell("PROGRAM study merge a");
  EXPECT_EQ(gap.code, 75);
  EXPECT_NE(gap.err.find("24 of 64 rows are missing, the first is row 8; run again: --shard 1/3 (24 rows)"),
            std::string::npos)
      << gap.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "a/results.h5"));
  const End partial = shell("PROGRAM study merge a --allow-missing --json");
  EXPECT_EQ(partial.code, 0);
  EXPECT_EQ(partial.json()["complete"], false);
  EXPECT_TRUE(std::filesystem::exists(folder / "a/results.h5"));
}

TEST_F(SweepCommand, MergeRefusesShardsOfAnotherStudy) {
  write_sweep();
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out a --shard 0/2").code, 0);
  write_sweep("[limits]\nfailure_share = 0.5\n");
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out b --shard 1/2").code, 0);
  std::filesystem::copy(folder / "b/shards/0001-of-0002.journal", folder / "a/shards/0001-of-0002.journal");
  const End mixed = shell("PROGRAM study merge a");
  EXPECT_EQ(mixed.code, 2);
  EXPECT_NE(mixed.err.find("0001-of-0002.journal"), std::string::npos) << mixed.err;
}

TEST_F(SweepCommand, CompareSaysWhatDiffers) {
  write_sweep();
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out a").code, 0);
  std::string text = file_text((folder / "sweep.toml").string());
  folder.write("sweep.toml", edited(text, "mesh.per_pitch = 3", "mesh.per_pitch = 4"));
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out b").code, 0);
  const End end = shell("PROGRAM study compare a b --json --exact");
  EXPECT_EQ(end.code, 3);
  EXPECT_EQ(end.json()["matched"], 64);
  EXPECT_GT(end.json()["outputs"]["peak_force_n"]["largest"], 0.0);
  EXPECT_EQ(end.json()["outputs"]["min_backlash_um"]["different"], 0); // kinematics knows no mesh
  EXPECT_EQ(shell("PROGRAM study compare a nowhere").code, 2);
}

/// Wall thicknesses that leave no cup fail; the others do not.
TEST_F(SweepCommand, FailedRowsAreNamedAndCounted) {
  write_sweep("[[variable]]\npath = \"wave_generator.eccentricity_mm\"\nvalues = [0.6, "
              "9.0]\n[limits]\nfailure_share = 0.6\n");
  const End run = shell("PROGRAM study run sweep.toml --out a --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto json = run.json();
  EXPECT_EQ(json["evaluations"]["failed"], 64);
  EXPECT_EQ(json["failures"][0]["count"], 64);
  EXPECT_FALSE(json["failures"][0]["example"].get<std::string>().empty());
  const End row = shell(
      fmt::format("PROGRAM eval --from a --index {} --json", json["failures"][0]["example_row"].get<int>()));
  EXPECT_EQ(row.code, 3);
  EXPECT_EQ(row.json()["message"], json["failures"][0]["example"]);
  EXPECT_EQ(row.json()["same_as_recorded"], true);
}

TEST_F(SweepCommand, TooManyFailuresEndWith3) {
  write_sweep("[[variable]]\npath = \"wave_generator.eccentricity_mm\"\nvalues = [0.6, 9.0]\n");
  const End run = shell("PROGRAM study run sweep.toml --out a --json");
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("64 of 128 rows failed, more than the share of 0.01"), std::string::npos) << run.err;
  EXPECT_EQ(run.json()["end"], "too_many_failed");
}

TEST_F(SweepCommand, AStudyThatAlwaysFailsStopsAtOnce) {
  write_sweep("[[variable]]\npath = \"wave_generator.eccentricity_mm\"\nvalues = [9.0, 9.5]\n");
  const End run = shell("PROGRAM study run sweep.toml --out a --json");
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("the first 20 rows all failed"), std::string::npos) << run.err;
  EXPECT_LT(run.json()["evaluations"]["done"], 64);
}

TEST_F(SweepCommand, PlanEstimatesAndFreezes) {
  write_sweep();
  const End plan = shell("PROGRAM study plan sweep.toml --out a --json");
  ASSERT_EQ(plan.code, 0) << plan.err;
  EXPECT_EQ(plan.json()["evaluations"], 64);
  EXPECT_EQ(plan.json()["cups"], 1);
  EXPECT_GT(plan.json()["seconds"], 0.0);
  EXPECT_EQ(shell("PROGRAM study status a").code, 0);
  write_sweep("[limits]\nfailure_share = 0.5\n");
  EXPECT_EQ(shell("PROGRAM study run sweep.toml --out a").code, 2); // another plan
}

TEST_F(SweepCommand, WrongUseEndsWith2) {
  write_sweep();
  for (const char* shard : {"3/3", "-1/3", "1", "1/3x", "1/0", "a/b"}) {
    const End end = shell(fmt::format("PROGRAM study run sweep.toml --out a --shard={}", shard));
    EXPECT_EQ(end.code, 2) << shard;
    EXPECT_NE(end.err.find("--shard wants I/N"), std::string::npos) << end.err;
  }
  const End search =
      shell("PROGRAM study run " + gallery + "seed_optimize_one_point.toml --reduced --shard 0/2");
  EXPECT_EQ(search.code, 2);
  EXPECT_NE(search.err.find("chooses every point by the ones before it"), std::string::npos) << search.err;
  EXPECT_EQ(shell("PROGRAM study status .").code, 2);
  EXPECT_EQ(shell("PROGRAM study merge .").code, 2);
  EXPECT_EQ(shell("PROGRAM eval --from . --index 0").code, 2);
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out b").code, 0);
  EXPECT_EQ(shell("PROGRAM eval --from b --index 64").code, 2);
}

TEST_F(SweepCommand, ReducedOvernightSweepOfTheGallery) {
  const End run =
      shell("PROGRAM study run " + gallery + "seed_overnight_sweep.toml --reduced --out a --json");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.json()["rows"], 48);
  EXPECT_EQ(run.json()["evaluations"]["failed"], 0);
}

} // namespace
} // namespace strainwave
