// Killed at random moments, disks that are full, folders that cannot be written, two writers: nothing is lost
// but what was in flight, and what comes out in the end is the uninterrupted study, bit for bit.

#include "tests/studies/study_shell.hpp"

#include <fstream>
#include <random>

namespace strainwave {
namespace {

class StudyCrash : public StudyShell {
protected:
  /// `study` is killed `kills` times; whenever it gets to its end in between, the result is compared and a
  /// new one begins.
  void kill_again_and_again(const std::string& study, int kills, double longest_s) {
    ASSERT_EQ(shell("PROGRAM study run " + study + " --out whole").code, 0);
    std::mt19937 random(static_cast<unsigned>(kills) + 17u);
    int killed = 0, ended = 0;
    while (killed < kills) {
      const double after = longest_s * (0.02 + 0.98 * static_cast<double>(random()) / 4294967296.0);
      const End end =
          shell(fmt::format("timeout -s KILL {:.3f} PROGRAM study run {} --out parts", after, study));
      if (end.code == 137) {
        ++killed;
        continue;
      }
      ASSERT_EQ(end.code, 0) << end.err;
      ASSERT_TRUE(identical("whole", "parts"));
      ++ended;
      std::filesystem::remove_all(folder / "parts");
    }
    ASSERT_EQ(shell("PROGRAM study run " + study + " --out parts").code, 0);
    EXPECT_TRUE(identical("whole", "parts"))
        << "after " << killed << " kills, " << ended << " ends in between";
  }

  void write_search(const std::string& kind, const std::string& more) {
    write_sweep();
    const std::string head = file_text((folder / "sweep.toml").string());
    folder.write(kind + ".toml",
                 edited(head.substr(0, head.find("[[variable]]")), "\"sweep\"", "\"" + kind + "\"") +
                     "[[variable]]\npath = \"flank_modification.flexspline.tip_relief_um\"\nlower = 0\n"
                     "upper = 15\n[objective]\noutput = \"peak_force_n\"\n[method]\nbudget = 40\n" +
                     more);
  }

  void write_sampled(const std::string& kind, const std::string& more) {
    write_sweep();
    const std::string head = file_text((folder / "sweep.toml").string());
    folder.write(kind + ".toml",
                 edited(head.substr(0, head.find("[[variable]]")), "\"sweep\"", "\"" + kind + "\"") +
                     "[[source]]\nname = \"pitch\"\nkind = \"adjacent_pitch\"\n"
                     "distribution = { normal = { mean = 0.0, std = 1.0 } }\n[[source]]\nname = \"run-out\"\n"
                     "kind = \"run_out\"\ndistribution = { lognormal = { mean = 1.0, std = 0.5 } }\n" +
                     more);
  }

  void kill_kind(const std::string& kind, int kills) {
    if (kind == "sweep") {
      write_sweep();
    } else if (kind == "optimize") {
      write_search(kind, "");
    } else if (kind == "pareto") {
      write_search(kind, "[pareto]\noutput = \"rotation_rad\"\npoints = 3\n");
    }
    if (kind == "monte_carlo")
      write_sampled(kind, "[sampling]\ndesign = \"sobol\"\nsamples = 65536\noutputs = [\"peak_force_n\"]\n");
    if (kind == "sensitivity")
      write_sampled(kind, "[sensitivity]\nsamples = 16384\noutputs = [\"peak_force_n\"]\n");
    kill_again_and_again(kind + ".toml", kills, 0.5);
  }
};

TEST_F(StudyCrash, TenKillsOfASweep) {
  kill_kind("sweep", 10);
}

TEST_F(StudyCrash, TenKillsOfAnOptimisation) {
  kill_kind("optimize", 10);
}

TEST_F(StudyCrash, TenKillsOfAMonteCarlo) {
  kill_kind("monte_carlo", 10);
}

class StudyCrashNightly : public StudyCrash {};

TEST_F(StudyCrashNightly, AHundredKillsOfASweep) {
  kill_kind("sweep", 100);
}

TEST_F(StudyCrashNightly, AHundredKillsOfAnOptimisation) {
  kill_kind("optimize", 100);
}

TEST_F(StudyCrashNightly, AHundredKillsOfAFront) {
  kill_kind("pareto", 100);
}

TEST_F(StudyCrashNightly, AHundredKillsOfAMonteCarlo) {
  kill_kind("monte_carlo", 100);
}

TEST_F(StudyCrashNightly, AHundredKillsOfASensitivity) {
  kill_kind("sensitivity", 100);
}

TEST_F(StudyCrash, TornAndFlippedTailsAreNamedCutAndEvaluatedAgain) {
  write_sweep();
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out whole").code, 0);
  std::filesystem::copy(folder / "whole", folder / "torn", std::filesystem::copy_options::recursive);
  const auto journal = folder / "torn/shards/0000-of-0001.journal";
  std::filesystem::resize_file(journal, std::filesystem::file_size(journal) - 5);
  const End torn = shell("PROGRAM study run sweep.toml --out torn --json");
  EXPECT_EQ(torn.code, 0) << torn.err;
  EXPECT_NE(torn.err.find("0000-of-0001.journal"), std::string::npos) << torn.err;
  EXPECT_EQ(torn.json()["evaluations"]["done"], 8); // one block
  EXPECT_TRUE(identical("whole", "torn"));
  {
    std::fstream file(journal, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(128 + 40); // within the first record
    file.put('\x55');
  }
  const End status = shell("PROGRAM study status torn");
  EXPECT_NE(status.out.find("64 rows are missing"), std::string::npos) << status.out;
  const End flipped = shell("PROGRAM study run sweep.toml --out torn --json");
  EXPECT_EQ(flipped.code, 0);
  EXPECT_EQ(flipped.json()["evaluations"]["done"], 64);
  EXPECT_TRUE(identical("whole", "torn"));
}

TEST_F(StudyCrash, AForeignJournalIsLeftAlone) {
  write_sweep();
  ASSERT_EQ(shell("PROGRAM study plan sweep.toml --out a").code, 0);
  std::filesystem::create_directory(folder / "a/shards");
  folder.write("a/shards/0000-of-0001.journal",
               "my diary, which is longer than the header of a journal: dear diary, dear diary, "
               "dear diary, dear diary, dear diary, dear diary");
  const std::string before = file_text((folder / "a/shards/0000-of-0001.journal").string());
  const End end = shell("PROGRAM study run sweep.toml --out a");
  EXPECT_EQ(end.code, 2) << end.err;
  EXPECT_EQ(file_text((folder / "a/shards/0000-of-0001.journal").string()), before);
}

/// RLIMIT_FSIZE answers a write past it like a full disk does: with an error.
TEST_F(StudyCrash, AFullDiskEndsWith74AndLosesNothing) {
  write_sweep();
  ASSERT_EQ(shell("PROGRAM study plan sweep.toml --out a").code, 0);
  const End full = shell("trap '' XFSZ; ulimit -f 1; exec PROGRAM study run sweep.toml --out a");
  EXPECT_EQ(full.code, 74) << full.err;
  EXPECT_NE(full.err.find("cannot write"), std::string::npos) << full.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "a/results.h5"));
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out a").code, 0);
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out b").code, 0);
  EXPECT_TRUE(identical("a", "b"));
}

/// /proc takes no folders from anybody, root included.
TEST_F(StudyCrash, AFolderThatCannotBeWrittenEndsWith74) {
  write_sweep();
  const End end = shell("PROGRAM study run sweep.toml --out /proc/strainwave-study");
  EXPECT_EQ(end.code, 74);
  EXPECT_NE(end.err.find("/proc/strainwave-study"), std::string::npos) << end.err;
}

TEST_F(StudyCrash, ASecondWriterOnAShardIsRefused) {
  write_sweep();
  ASSERT_EQ(shell("PROGRAM study run sweep.toml --out a --time-limit 0.05 --threads 1").code, 75);
  const End second = shell("flock -x a/shards/0000-of-0001.journal -c 'PROGRAM study run sweep.toml --out a; "
                           "code=$?; PROGRAM study "
                           "status a; exit $code'");
  EXPECT_EQ(second.code, 74) << second.err;
  EXPECT_NE(second.err.find("is being written by another process"), std::string::npos) << second.err;
  EXPECT_NE(second.out.find("running"), std::string::npos) << second.out;
  EXPECT_EQ(shell("PROGRAM study run sweep.toml --out a").code, 0);
}

TEST_F(StudyCrash, SignalsEndASweepWith75) {
  write_sweep();
  std::string text = file_text((folder / "sweep.toml").string());
  folder.write("sweep.toml", edited(text, "count = 16", "count = 16000"));
  for (const char* signal : {"INT", "TERM", "USR1"}) {
    const End end =
        shell(fmt::format("(sleep 0.4; kill -{} $(cat pid)) & sh -c 'echo $$ > pid; exec PROGRAM study run "
                          "sweep.toml --out a'",
                          signal));
    EXPECT_EQ(end.code, 75) << signal << end.err;
    EXPECT_NE(end.err.find("stopped early by a signal"), std::string::npos) << end.err;
  }
}

} // namespace
} // namespace strainwave
