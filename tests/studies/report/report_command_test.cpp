// `strainwave report`: one page that needs nothing else.

#include "tests/studies/study_shell.hpp"

namespace strainwave {
namespace {

class ReportCommand : public StudyShell {
protected:
  std::string page(const std::string& study) {
    const End run = shell("PROGRAM study run " + study + " --out a");
    EXPECT_EQ(run.code, 0) << run.err;
    const End end = shell("PROGRAM report a");
    EXPECT_EQ(end.code, 0) << end.err;
    EXPECT_EQ(end.out, "a/report.html\n");
    return file_text((folder / "a/report.html").string());
  }
  /// Opened and closed equally often, nothing from the network, at least one picture inside.
  static void expect_whole(const std::string& page) {
    const auto count = [&](const std::string& what) {
      int n = 0;
      for (std::size_t at = 0; (at = page.find(what, at)) != std::string::npos; ++at)
        ++n;
      return n;
    };
    EXPECT_EQ(count("<table"), count("</table>"));
    EXPECT_EQ(count("<tr>"), count("</tr>"));
    EXPECT_EQ(count("<td"), count("</td>"));
    EXPECT_EQ(count("http://") + count("https://") + count("<script") + count("<link"), 0);
    EXPECT_GE(count("src=\"data:image/svg+xml;base64,"), 1);
    EXPECT_NE(page.find("</html>"), std::string::npos);
  }
};

TEST_F(ReportCommand, OfASweepShowsRangesAndFailures) {
  write_sweep("[[variable]]\npath = \"wave_generator.eccentricity_mm\"\nvalues = [0.6, "
              "9.0]\n[limits]\nfailure_share = 0.6\n");
  const std::string text = page("sweep.toml");
  expect_whole(text);
  EXPECT_NE(text.find("peak_force_n"), std::string::npos);
  EXPECT_NE(text.find("Evaluations without a result"), std::string::npos);
  EXPECT_NE(text.find("strainwave eval --from a --index"), std::string::npos);
}

TEST_F(ReportCommand, OfEveryKindOfTheGalleryIsWhole) {
  for (const char* name : {"seed_relief_only", "seed_tolerance", "seed_sensitivity", "seed_convergence"}) {
    expect_whole(page(gallery + name + ".toml --reduced"));
    std::filesystem::remove_all(folder / "a");
  }
}

TEST_F(ReportCommand, WithoutAnyResultSaysWhatToDo) {
  write_sweep();
  ASSERT_EQ(shell("PROGRAM study plan sweep.toml --out a").code, 0);
  const End none = shell("PROGRAM report a");
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("run the study to its end"), std::string::npos) << none.err;
  EXPECT_EQ(shell("PROGRAM report .").code, 2);
}

} // namespace
} // namespace strainwave
