// `strainwave study run` as a program: exit codes, files, stdout that carries the result alone.

#include "tests/model/gear_file/files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

namespace strainwave {
namespace {

const std::string gallery = STRAINWAVE_SOURCE "/studies/gallery/";

class StudyCommand : public testing::Test {
protected:
  struct End {
    int code;
    std::string out, err;
  };

  /// A shell line in which PROGRAM stands for the program, in a folder of its own.
  End shell(std::string line) {
    for (std::size_t place; (place = line.find("PROGRAM")) != std::string::npos;)
      line.replace(place, 7, STRAINWAVE_PROGRAM);
    const int status = std::system(
        fmt::format("cd '{}' && ( {} ) > out.txt 2> err.txt < /dev/null", (folder / "").string(), line)
            .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, file_text((folder / "out.txt").string()),
            file_text((folder / "err.txt").string())};
  }

  TemporaryFolder folder;
};

TEST_F(StudyCommand, ReducedGalleryStudyEndsInAGearThatAnalyzeAccepts) {
  const End run = shell("PROGRAM study run " + gallery + "seed_optimize_one_point.toml --reduced --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["verdict"], "converged");
  EXPECT_EQ(json["folder"], "seed_optimize_one_point-reduced-result");
  const End again = shell("PROGRAM analyze seed_optimize_one_point-reduced-result/best.toml --json");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(nlohmann::json::parse(again.out)["load"][0]["peak_force_n"],
            json["best"]["outputs"]["peak_force_n"]);
}

TEST_F(StudyCommand, EveryReducedStudyOfTheGalleryEndsWithADesign) {
  for (const char* name : {"seed_relief_only", "seed_multi_load", "seed_pareto"}) {
    const End run = shell(fmt::format("PROGRAM study run {}{}.toml --reduced --json", gallery, name));
    EXPECT_EQ(run.code, 0) << name << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_LT(json["best"]["outputs"]["peak_force_n"], json["baseline"]["outputs"]["peak_force_n"]) << name;
  }
}

TEST_F(StudyCommand, TimeLimitStopsWith75) {
  const End end =
      shell("PROGRAM study run " + gallery + "seed_optimize_one_point.toml --time-limit 0.2 --threads 1");
  EXPECT_EQ(end.code, 75) << end.err;
  EXPECT_NE(end.err.find("stopped"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "seed_optimize_one_point-result/plan.json"));
}

TEST_F(StudyCommand, FolderOfAnotherStudyIsRefusedAndFinishedResultsAreAnsweredFromIt) {
  const std::string first =
      "PROGRAM study run " + gallery + "seed_relief_only.toml --reduced --out kept --json";
  const End whole = shell(first);
  ASSERT_EQ(whole.code, 0);
  const std::string best = file_text((folder / "kept/best.toml").string());
  const End other =
      shell("PROGRAM study run " + gallery + "seed_optimize_one_point.toml --reduced --out kept");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("another study"), std::string::npos) << other.err;
  const End again = shell(first);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(nlohmann::json::parse(again.out)["evaluations"]["done"], 0);
  EXPECT_EQ(nlohmann::json::parse(again.out)["best"], nlohmann::json::parse(whole.out)["best"]);
  EXPECT_EQ(file_text((folder / "kept/best.toml").string()), best);
}

TEST_F(StudyCommand, SignalsStopWith75) {
  for (const char* signal : {"INT", "TERM", "USR1"}) {
    // SIGINT is ignored by background jobs of a shell without job control, so the program is the foreground
    // one.
    const End end =
        shell(fmt::format("(sleep 0.3; kill -{} $(cat pid)) & sh -c 'echo $$ > pid; exec PROGRAM study run "
                          "{}seed_optimize_one_point.toml --threads 1'",
                          signal, gallery));
    EXPECT_EQ(end.code, 75) << signal << end.err;
  }
}

TEST_F(StudyCommand, WrongFilesEndWith2AndThePlace) {
  folder.write("seed.toml", file_text(gallery + "seed.toml"));
  const std::string good = file_text(gallery + "seed_optimize_one_point.toml");
  const auto complaint = [&](const std::string& old, const std::string& replacement) {
    std::string text = good;
    text.replace(text.find(old), old.size(), replacement);
    folder.write("study.toml", text);
    const End end = shell("PROGRAM study run study.toml");
    EXPECT_EQ(end.code, 2) << replacement;
    EXPECT_EQ(end.out, "");
    return end.err;
  };
  EXPECT_NE(complaint("tip_relief_um\"", "tip_releif_um\"").find("study.toml:13:8"), std::string::npos);
  EXPECT_NE(complaint("peak_force_n", "peak_force").find("did you mean \"peak_force_n\"?"),
            std::string::npos);
  EXPECT_NE(complaint("\"global_then_polish\"", "\"cobila\"").find("did you mean \"cobyla\"?"),
            std::string::npos);
  EXPECT_NE(complaint("start = 2.0", "start = 20.0").find("between lower"), std::string::npos);
}

TEST_F(StudyCommand, OutputThatTheLoadsCannotGiveIsRefusedWithTheRemedy) {
  folder.write("seed.toml", file_text(gallery + "seed.toml"));
  std::string text = file_text(gallery + "seed_optimize_one_point.toml");
  for (const auto& [old, replacement] :
       {std::pair{"phases = 4", "phases = 1"}, {"\"peak_force_n\"", "\"transmission_error_arcsec\""}})
    text.replace(text.find(old), std::string(old).size(), replacement);
  folder.write("study.toml", text);
  const End end = shell("PROGRAM study run study.toml");
  EXPECT_EQ(end.code, 2);
  EXPECT_NE(end.err.find("objective.output: transmission_error_arcsec needs a load case"), std::string::npos)
      << end.err;
}

TEST_F(StudyCommand, NoFeasibleDesignEndsWith3AndShowsTheNearest) {
  folder.write("seed.toml", file_text(gallery + "seed.toml"));
  std::string text = file_text(gallery + "seed_optimize_one_point.toml");
  text.replace(text.find("min_ratio_to_baseline = 0.95"), 28, "min_ratio_to_baseline = 1.95");
  folder.write("study.toml", text);
  const End end = shell("PROGRAM study run study.toml --reduced");
  EXPECT_EQ(end.code, 3);
  EXPECT_NE(end.out.find("VIOLATED"), std::string::npos) << end.out;
}

TEST_F(StudyCommand, FolderThatCannotBeMadeEndsWith74) {
  folder.write("taken", "a file");
  EXPECT_EQ(
      shell("PROGRAM study run " + gallery + "seed_optimize_one_point.toml --reduced --out taken/results")
          .code,
      74);
}

} // namespace
} // namespace strainwave
