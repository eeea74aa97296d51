// The program itself: exit codes, and stdout that carries results only.

#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

namespace fs = std::filesystem;
using strainwave::testing_support::text_of;

class CommandLine : public testing::Test {
protected:
  struct End {
    int code;
    std::string out, err;
  };

  /// `arguments` as in a shell, in a folder of its own.
  End run(const std::string& arguments) {
    const std::string command = fmt::format("cd '{0}' && '{1}' {2} > out.txt 2> err.txt < /dev/null",
                                            folder.string(), STRAINWAVE_PROGRAM, arguments);
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder / "out.txt"),
            text_of(folder / "err.txt")};
  }

  /// The exit code of a whole shell line in which PROGRAM stands for the program.
  int shell(std::string line) {
    for (std::size_t place; (place = line.find("PROGRAM")) != std::string::npos;)
      line.replace(place, 7, STRAINWAVE_PROGRAM);
    const int status =
        std::system(fmt::format("cd '{}' && bash -c '{}' 2> err.txt", folder.string(), line).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  void write(const std::string& name, const std::string& text) { temporary.write(name, text); }

  void expect_wrong_use(const std::string& arguments, const std::string& sentence,
                        const std::string& help = "strainwave") {
    const End end = run(arguments);
    EXPECT_EQ(end.code, 2) << arguments;
    EXPECT_EQ(end.out, "") << arguments;
    EXPECT_EQ(end.err,
              fmt::format("strainwave: {}\nstrainwave: `{} --help` explains the use\n", sentence, help))
        << arguments;
  }

  strainwave::testing_support::TemporaryFolder temporary;
  fs::path folder = temporary.path;
};

const std::string seed = text_of(STRAINWAVE_SOURCE "/studies/gallery/seed.toml");

TEST_F(CommandLine, ExampleIsTheGallerysSeedGear) {
  const End end = run("example");
  EXPECT_EQ(end.code, 0);
  EXPECT_EQ(end.out, seed);
  EXPECT_EQ(end.err, "");
}

TEST_F(CommandLine, CheckPrintsTheWholeGearAndAcceptsWhatItPrinted) {
  write("gear.toml", seed);
  const End first = run("check gear.toml");
  EXPECT_EQ(first.code, 0);
  EXPECT_EQ(first.err, "");
  write("again.toml", first.out);
  EXPECT_EQ(run("check again.toml").out, first.out);
}

TEST_F(CommandLine, CheckOfAWrongFileSaysWhereAndPrintsNothing) {
  write("gear.toml", "name = \"x\"\ncolour = 3\n");
  const End end = run("check gear.toml");
  EXPECT_EQ(end.code, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_NE(end.err.find("strainwave: gear.toml:2:1: colour: no such key"), std::string::npos);
}

std::string seed_with(const std::string& before, const std::string& after) {
  std::string text = seed;
  return text.replace(text.find(before), before.size(), after);
}

TEST_F(CommandLine, CheckOfAFormerNameSaysWhatIsDoneAndPrintsTheNewOne) {
  write("gear.toml", seed_with("method = \"direct\"", "method = \"event_path\""));
  const End end = run("check gear.toml");
  EXPECT_EQ(end.code, 0);
  EXPECT_NE(
      end.err.find("contact.method: \"event_path\" is called \"direct\" now: every load is solved directly"),
      std::string::npos)
      << end.err;
  EXPECT_NE(end.out.find("method = \"direct\""), std::string::npos);
  EXPECT_EQ(end.out.find("event_path"), std::string::npos);
}

TEST_F(CommandLine, CheckOfAGearThatContradictsItselfEndsWith3) {
  write("gear.toml", seed_with("boss_radius_mm = 5.0", "boss_radius_mm = 14.0"));
  const End end = run("check gear.toml");
  EXPECT_EQ(end.code, 3);
  EXPECT_TRUE(end.err.starts_with("strainwave: gear.toml: flexspline.boss_radius_mm 14 must be less than"))
      << end.err;
}

TEST_F(CommandLine, CheckOfAGearWithoutWrapEndsWith3) {
  write("gear.toml", seed_with("eccentricity_mm = 0.6", "eccentricity_mm = 6.0")); // e/u0 = 30
  const End end = run("check gear.toml");
  EXPECT_EQ(end.code, 3);
  EXPECT_TRUE(end.err.starts_with("strainwave: ")) << end.err;
  EXPECT_NE(end.err.find("30"), std::string::npos) << end.err; // the offending ratio
}

TEST_F(CommandLine, CheckOfAStudyPrintsTheWholeStudy) {
  write("gear.toml", seed);
  write("study.toml", "kind = \"optimize\"\ngear = \"gear.toml\"\n[objective]\noutput = \"peak_force_n\"\n"
                      "[[variable]]\npath = \"circular_spline.profile_shift\"\nlower = 2.1\nupper = 2.3\n");
  const End end = run("check study.toml");
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_NE(end.out.find("[[load_case]]\ntorque_nm = 11.5"), std::string::npos);
  EXPECT_NE(end.out.find("goal = \"minimise\""), std::string::npos);
}

TEST_F(CommandLine, MissingFileIsWrongInput) {
  const End end = run("check gear.toml");
  EXPECT_EQ(end.code, 2);
  EXPECT_EQ(end.err,
            "strainwave: gear.toml: no such gear file; `strainwave example` prints one to start from\n");
}

TEST_F(CommandLine, UnreadableFileIsTheEnvironment) {
  write("gear.toml", seed);
  fs::permissions(folder / "gear.toml", fs::perms::none);
  // Root reads everything, unless it gives that right away.
  const std::string plain = geteuid() == 0 ? "setpriv --bounding-set=-dac_override,-dac_read_search " : "";
  EXPECT_EQ(shell(plain + "PROGRAM check gear.toml"), 74);
  EXPECT_EQ(text_of(folder / "err.txt"), "strainwave: cannot read gear.toml: Permission denied\n");
}

TEST_F(CommandLine, AReadErrorIsTheEnvironment) {
  if (!fs::exists("/proc/self/mem"))
    GTEST_SKIP();
  const End end = run("check /proc/self/mem"); // opens, but its first page cannot be read
  EXPECT_EQ(end.code, 74);
  EXPECT_EQ(end.err, "strainwave: cannot read /proc/self/mem: Input/output error\n");
}

TEST_F(CommandLine, SchemaIsJsonAndReferenceIsMarkdown) {
  const End schema = run("schema");
  EXPECT_EQ(schema.code, 0);
  EXPECT_TRUE(schema.out.starts_with("{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\""));
  EXPECT_TRUE(run("schema --reference").out.starts_with("# The gear file\n"));
}

TEST_F(CommandLine, HelpAndVersionAreResults) {
  for (const std::string arguments :
       {"--help", "-h", "check --help", "example --help", "schema --help", "--version"}) {
    const End end = run(arguments);
    EXPECT_EQ(end.code, 0) << arguments;
    EXPECT_NE(end.out, "") << arguments;
    EXPECT_EQ(end.err, "") << arguments;
  }
  EXPECT_TRUE(run("--version").out.starts_with("strainwave "));
}

TEST_F(CommandLine, HelpNamesEveryCommandAndExitCode) {
  const std::string help = run("--help").out;
  for (const std::string word :
       {"example", "check", "schema", "0 done", "2 wrong", "3 the gear", "70 a bug", "74 disk", "75 stopped"})
    EXPECT_NE(help.find(word), std::string::npos) << word;
}

TEST_F(CommandLine, WrongCommandsNameTheNearest) {
  expect_wrong_use("chek gear.toml", "there is no command chek; did you mean check?");
  expect_wrong_use("chek --help", "there is no command chek; did you mean check?");
  expect_wrong_use("exmaple", "there is no command exmaple; did you mean example?");
  expect_wrong_use("help", "there is no command help; did you mean --help?");
}

TEST_F(CommandLine, WrongOptionsNameTheNearest) {
  expect_wrong_use("--vershion", "there is no option --vershion; did you mean --version?");
  expect_wrong_use("check --hlep gear.toml", "there is no option --hlep; did you mean --help?",
                   "strainwave check");
  expect_wrong_use("schema --referenc=3", "there is no option --referenc; did you mean --reference?",
                   "strainwave schema");
}

TEST_F(CommandLine, WrongValuesOfOptionsSayWhatWasExpected) {
  const std::string help = "strainwave analyze";
  expect_wrong_use("analyze g.toml --torque-nm abc", "--torque-nm: expected a number, got abc", help);
  expect_wrong_use("analyze g.toml --torque-nm", "--torque-nm: the value is missing", help);
  expect_wrong_use("analyze g.toml --threads -1", "--threads: expected a number of at least 0, got -1", help);
  expect_wrong_use("analyze g.toml --only backlsh",
                   "--only: expected backlash, compliance, load, got backlsh; did you mean backlash?", help);
}

TEST_F(CommandLine, MissingAndSuperfluousArgumentsAreNamed) {
  expect_wrong_use("check", "FILE is required", "strainwave check");
  expect_wrong_use("check a.toml b.toml", "b.toml is one argument too many", "strainwave check");
  const End end = run("");
  EXPECT_EQ(end.code, 2);
  EXPECT_TRUE(end.err.starts_with("strainwave: a command is missing; expected one of "));
}

TEST_F(CommandLine, AFullDiskUnderStdoutIsTheEnvironment) {
  if (!fs::exists("/dev/full"))
    GTEST_SKIP();
  EXPECT_EQ(shell("PROGRAM example > /dev/full"), 74);
  EXPECT_EQ(text_of(folder / "err.txt"),
            "strainwave: cannot write to standard output: No space left on device\n");
}

TEST_F(CommandLine, AClosedStdoutIsTheEnvironment) {
  EXPECT_EQ(shell("PROGRAM example >&-"), 74);
  EXPECT_EQ(text_of(folder / "err.txt"),
            "strainwave: cannot write to standard output: Bad file descriptor\n");
}

TEST_F(CommandLine, AReaderThatStopsIsNoFault) {
  // The reader is gone before the program starts to write.
  EXPECT_EQ(shell("{ sleep 0.2; PROGRAM schema; echo $? > code.txt; } | true"), 0);
  EXPECT_EQ(text_of(folder / "code.txt"), "0\n");
  EXPECT_EQ(text_of(folder / "err.txt"), "");
}

} // namespace
