// The recipes of studies/cluster, tried with the real tools: a shard is killed, run again, and the joined
// study is the uninterrupted one, bit for bit. Skipped where a tool is not installed.

#include "tests/studies/study_shell.hpp"

#include <unistd.h>

namespace strainwave {
namespace {

const std::string recipes = STRAINWAVE_SOURCE "/studies/cluster/";

class ClusterNightly : public StudyShell {
protected:
  void TearDown() override {
    if (std::filesystem::exists(folder / "slurm"))
      shell(recipes + "one-node-slurm.sh stop slurm; sleep 1");
  }

  /// 6400 rows: some seconds in three shards.
  void write_study() {
    write_sweep();
    const std::string text = file_text((folder / "sweep.toml").string());
    folder.write("sweep.toml", edited(text, "count = 16", "count = 1600"));
    ASSERT_EQ(shell("PROGRAM study run sweep.toml --out whole").code, 0);
  }
  bool installed(const std::string& tool) {
    return shell("PATH=$PATH:/usr/sbin command -v " + tool).code == 0;
  }

  /// Waits until shard 1 has written something, then kills the process that holds its journal.
  static constexpr const char* kill_shard_1 =
      "for i in $(seq 400); do [ \"$(stat -c %s night/shards/0001-of-0003.journal 2>/dev/null || echo 0)\" "
      "-gt 200 ] && "
      "break; sleep 0.05; done; for p in /proc/[0-9]*; do if ls -l $p/fd 2>/dev/null | grep -q "
      "\"$PWD/night/shards/0001-of-0003\"; "
      "then kill -KILL ${p#/proc/}; echo killed; fi; done";
};

TEST_F(ClusterNightly, GnuParallelWithAKilledShard) {
  if (!installed("parallel"))
    GTEST_SKIP() << "GNU parallel is not installed";
  write_study();
  const std::string run = "STRAINWAVE=PROGRAM " + recipes + "parallel.sh sweep.toml night 3 2";
  const End first = shell("(" + run + ") & " + kill_shard_1 + "; wait $!");
  EXPECT_NE(first.out.find("killed"), std::string::npos) << first.out << first.err;
  EXPECT_NE(first.code, 0);
  const End again = shell(run);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(identical("whole", "night"));
}

TEST_F(ClusterNightly, SnakemakeWithAKilledShard) {
  if (!installed("snakemake"))
    GTEST_SKIP() << "Snakemake is not installed";
  write_study();
  const std::string run = "STRAINWAVE=PROGRAM snakemake -s " + recipes +
                          "Snakefile --cores 2 --config study=sweep.toml dir=night shards=3";
  const End first = shell("(" + run + ") & " + kill_shard_1 + "; wait $!");
  EXPECT_NE(first.out.find("killed"), std::string::npos) << first.out << first.err;
  if (first.code != 0) { // else its own retry has run the shard again
    const End again = shell(run);
    EXPECT_EQ(again.code, 0) << again.err;
  }
  EXPECT_TRUE(identical("whole", "night"));
}

TEST_F(ClusterNightly, SlurmJobArrayWithAKilledShard) {
  if (!installed("slurmctld") || !installed("munged") || ::geteuid() != 0)
    GTEST_SKIP()
        << "slurm-wlm and munge are not installed, or this is not root, whom a Slurm of one node needs";
  write_study();
  shell("chmod 755 .");
  const End start = shell(recipes + "one-node-slurm.sh start slurm");
  ASSERT_EQ(start.code, 0) << start.err;
  const std::string with = "export SLURM_CONF=$PWD/slurm/slurm.conf STRAINWAVE=PROGRAM; ";
  const std::string wait = "while squeue --noheader | grep -q .; do sleep 0.5; done; ";
  const End array =
      shell(with + "PROGRAM study plan sweep.toml --out night > plan.txt; sbatch --parsable --array=0-2 " +
            recipes + "study.sbatch sweep.toml night; " + kill_shard_1 + "; " + wait);
  EXPECT_NE(array.out.find("killed"), std::string::npos) << array.out << array.err;
  const End gap = shell("PROGRAM study merge night");
  EXPECT_EQ(gap.code, 75) << gap.err;
  EXPECT_NE(gap.err.find("--shard 1/3"), std::string::npos) << gap.err;
  const End again = shell(with + "job=$(sbatch --parsable --array=1 " + recipes +
                          "study.sbatch sweep.toml night 3) && sbatch --dependency=afterok:$job " + recipes +
                          "merge.sbatch night; " + wait);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(identical("whole", "night"));
}

} // namespace
} // namespace strainwave
