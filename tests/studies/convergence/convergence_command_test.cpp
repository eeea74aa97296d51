// Convergence as a program: every row is the gear on that mesh; it resumes, shards and reports like all
// kinds.

#include "tests/studies/study_shell.hpp"

namespace strainwave {
namespace {

class ConvergenceCommand : public StudyShell {
protected:
  void write_study() {
    folder.write("seed.toml", file_text(gallery + "seed.toml"));
    folder.write("mesh.toml", R"(kind = "convergence"
gear = "seed.toml"
[override]
mesh.per_pitch = 3
mesh.along_wall = 4
mesh.diaphragm = 3
mesh.tooth_height = 1
[[load_case]]
torque_nm = 7.0
[[refine]]
path = "mesh.along_face"
values = [2, 3, 4]
[[refine]]
path = "mesh.along_wall"
values = [4, 6, 8]
[convergence]
outputs = ["peak_force_n", "rotation_rad"]
)");
  }
};

TEST_F(ConvergenceCommand, RowsAreMeshesAndTheAnswerIsTheirOrder) {
  write_study();
  const End run = shell("PROGRAM study run mesh.toml --out a --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto json = run.json();
  EXPECT_EQ(json["kind"], "convergence");
  EXPECT_EQ(json["rows"], 3);
  const auto& force = json["convergence"]["peak_force_n"];
  ASSERT_EQ(force["levels"].size(), 3u);
  EXPECT_DOUBLE_EQ(force["levels"][2]["size"].get<double>(), 0.5);
  const End row = shell("PROGRAM eval --from a --index 1 --json --gear row.toml");
  ASSERT_EQ(row.code, 0) << row.err;
  EXPECT_EQ(row.json()["same_as_recorded"], true);
  EXPECT_EQ(row.json()["inputs"]["mesh.along_wall"], 6.0);
  EXPECT_EQ(row.json()["outputs"]["peak_force_n"], force["levels"][1]["value"]);
  const End analysis = shell("PROGRAM analyze row.toml --json");
  ASSERT_EQ(analysis.code, 0) << analysis.err;
  EXPECT_EQ(analysis.json()["load"][0]["peak_force_n"], force["levels"][1]["value"]);
  const double before = force["levels"][1]["value"], after = force["levels"][2]["value"];
  EXPECT_DOUBLE_EQ(force["levels"][2]["change"].get<double>(), (after - before) / after);
}

TEST_F(ConvergenceCommand, ShardsGiveTheSameBitsAndThePageIsWhole) {
  write_study();
  ASSERT_EQ(shell("PROGRAM study run mesh.toml --out one").code, 0);
  ASSERT_EQ(shell("for i in 0 1; do PROGRAM study run mesh.toml --out two --shard $i/2 || exit 9; done; "
                  "PROGRAM study merge two")
                .code,
            0);
  EXPECT_TRUE(identical("one", "two"));
  const End again = shell("PROGRAM study run mesh.toml --out one --json"); // answered from the journal
  EXPECT_EQ(again.json()["evaluations"]["reused"], 3);
  const End plan = shell("PROGRAM study plan mesh.toml --out plan --json");
  EXPECT_EQ(plan.code, 0) << plan.err;
  const End page = shell("PROGRAM report one");
  ASSERT_EQ(page.code, 0) << page.err;
  const std::string html = file_text((folder / "one/report.html").string());
  EXPECT_NE(html.find("<h2>peak_force_n</h2>"), std::string::npos);
  EXPECT_NE(html.find("observed order"), std::string::npos);
  EXPECT_NE(html.find("src=\"data:image/svg+xml;base64,"), std::string::npos);
}

} // namespace
} // namespace strainwave
