// Monte Carlo and sensitivity as a program: what comes out, and that it is the same bits however it was run.

#include "tests/studies/study_shell.hpp"

namespace strainwave {
namespace {

class ToleranceCommand : public StudyShell {
protected:
  void write_study(const std::string& kind, const std::string& more) {
    write_sweep();
    const std::string head = file_text((folder / "sweep.toml").string());
    folder.write(kind + ".toml",
                 edited(head.substr(0, head.find("[[variable]]")), "\"sweep\"", "\"" + kind + "\"") +
                     R"([[source]]
name = "pitch"
kind = "adjacent_pitch"
distribution = { normal = { mean = 0.0, std = 1.0 } }
[[source]]
name = "x2"
kind = "gear_key"
path = "circular_spline.profile_shift"
distribution = { normal = { mean = 2.19, std = 0.005 } }
)" + more);
  }
  void write_monte_carlo(const std::string& sampling) {
    write_study("monte_carlo",
                "[sampling]\n" + sampling + "outputs = [\"peak_force_n\", \"rotation_rad\"]\n");
  }
  void write_sensitivity(const std::string& method) {
    write_study("sensitivity",
                "[sensitivity]\n" + method + "outputs = [\"peak_force_n\", \"rotation_rad\"]\n");
  }
  /// One process with 1 and with 2 threads, and as many processes as there are shards.
  void expect_same_bits(const std::vector<int>& shard_counts) {
    write_monte_carlo("design = \"sobol\"\nsamples = 8192\n");
    write_sensitivity("method = \"sobol\"\nsamples = 1024\n");
    for (const std::string kind : {"monte_carlo", "sensitivity"}) {
      ASSERT_EQ(shell(fmt::format("PROGRAM study run {0}.toml --out {0}-one --threads 1", kind)).code, 0);
      ASSERT_EQ(shell(fmt::format("PROGRAM study run {0}.toml --out {0}-two --threads 2", kind)).code, 0);
      EXPECT_TRUE(identical(kind + "-one", kind + "-two"));
      for (const int shards : shard_counts) {
        const std::string out = fmt::format("{}-{}", kind, shards);
        ASSERT_EQ(
            shell(fmt::format(
                      "for i in $(seq 0 {}); do PROGRAM study run {}.toml --out {} --shard $i/{} || exit 9; "
                      "done; PROGRAM study merge {} --json > merged.json",
                      shards - 1, kind, out, shards, out))
                .code,
            0);
        EXPECT_TRUE(identical(kind + "-one", out)) << shards;
        const auto whole = nlohmann::json::parse(file_text((folder / (kind + "-one/result.json")).string()));
        const auto merged = nlohmann::json::parse(file_text((folder / "merged.json").string()));
        for (const char* key : {"statistics", "indices"})
          EXPECT_EQ(whole.value(key, nlohmann::json()), merged.value(key, nlohmann::json())) << kind << key;
      }
    }
  }
};

TEST_F(ToleranceCommand, ThreadsAndShardsGiveTheSameBits) {
  expect_same_bits({3});
}

class ToleranceCommandNightly : public ToleranceCommand {};

TEST_F(ToleranceCommandNightly, SixtyFourShardsGiveTheSameBits) {
  expect_same_bits({64});
}

TEST_F(ToleranceCommand, EveryDesignGivesStatisticsThatAgree) {
  double mean[3] = {}, half[3] = {};
  int i = 0;
  for (const char* design : {"random", "latin_hypercube", "sobol"}) {
    write_monte_carlo(fmt::format("design = \"{}\"\nsamples = 8192\nquantiles = [0.5, 0.9]\n", design));
    const End run = shell(fmt::format("PROGRAM study run monte_carlo.toml --out {} --json", design));
    ASSERT_EQ(run.code, 0) << run.err;
    const auto s = run.json()["statistics"]["rotation_rad"];
    EXPECT_EQ(s["samples"], 8192);
    EXPECT_LT(s["quantiles"]["0.5"], s["quantiles"]["0.9"]);
    mean[i] = s["mean"];
    half[i] = 0.5 * (s["ci95"]["mean"][1].get<double>() - s["ci95"]["mean"][0].get<double>());
    EXPECT_GT(half[i], 0.0);
    // a thinner space is a smaller clearance: less rotation before the teeth carry
    EXPECT_GT(s["correlation"]["x2"]["pearson"]["value"], 0.5);
    ++i;
  }
  for (int j = 1; j < 3; ++j) // 2.5 times the 95 % half widths of both: once in 10^6
    EXPECT_NEAR(mean[j], mean[0], 2.5 * (half[0] + half[j]));
}

TEST_F(ToleranceCommand, StopEndsAtABoundaryOfItsOwnWhateverTheThreads) {
  write_monte_carlo(
      "design = \"random\"\nsamples = 100000\nstop = { output = \"rotation_rad\", half_width = 1e-5 }\n");
  ASSERT_EQ(shell("PROGRAM study run monte_carlo.toml --out one --threads 1").code, 0);
  const End two = shell("PROGRAM study run monte_carlo.toml --out two --threads 2 --json");
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_EQ(two.json()["end"], "enough");
  EXPECT_EQ(two.json()["complete"], true);
  EXPECT_TRUE(identical("one", "two"));
  const auto s = two.json()["statistics"]["rotation_rad"];
  EXPECT_LT(s["samples"], 100000);
  EXPECT_LE(0.5 * (s["ci95"]["mean"][1].get<double>() - s["ci95"]["mean"][0].get<double>()), 1e-5);
  const End shard = shell("PROGRAM study run monte_carlo.toml --out three --shard 0/2");
  EXPECT_EQ(shard.code, 2);
  EXPECT_NE(shard.err.find("cannot be cut into shards"), std::string::npos) << shard.err;
}

TEST_F(ToleranceCommand, IndicesOfTwoSourcesShareTheVariance) {
  write_sensitivity("method = \"sobol\"\nsamples = 2048\n");
  const End run = shell("PROGRAM study run sensitivity.toml --out a --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto indices = run.json()["indices"]["rotation_rad"];
  double first = 0.0;
  for (const char* source : {"pitch", "x2"}) {
    first += indices[source]["first"].get<double>();
    // a first index is at most the total one; both are estimates, so their intervals decide
    EXPECT_LE(indices[source]["ci95"]["first"][0], indices[source]["ci95"]["total"][1]);
  }
  EXPECT_GT(first, 0.8); // rotation is nearly additive in small clearances
  EXPECT_LT(first, 1.2);
  EXPECT_EQ(run.json()["blocks"]["rotation_rad"]["dropped"], 0);
  write_sensitivity("method = \"morris\"\nsamples = 20\n");
  const End morris = shell("PROGRAM study run sensitivity.toml --out b --json");
  ASSERT_EQ(morris.code, 0) << morris.err;
  EXPECT_GT(morris.json()["indices"]["rotation_rad"]["x2"]["mu_star"], 0.0);
}

TEST_F(ToleranceCommand, ASampleIsReproducedByItsNumber) {
  write_monte_carlo("design = \"sobol\"\nsamples = 1024\n");
  ASSERT_EQ(shell("PROGRAM study run monte_carlo.toml --out a").code, 0);
  for (const int row : {0, 511, 1023}) {
    const End end = shell(fmt::format("PROGRAM eval --from a --index {} --json", row));
    ASSERT_EQ(end.code, 0) << end.err;
    EXPECT_EQ(end.json()["same_as_recorded"], true) << row;
  }
}

TEST_F(ToleranceCommand, ReducedStudiesOfTheGallery) {
  for (const char* name : {"seed_tolerance", "seed_sensitivity"}) {
    const End run = shell(fmt::format("PROGRAM study run {}{}.toml --reduced --json", gallery, name));
    EXPECT_EQ(run.code, 0) << name << run.err;
    EXPECT_EQ(run.json()["complete"], true);
  }
}

} // namespace
} // namespace strainwave
