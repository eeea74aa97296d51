// What the program meets outside of itself: files that are none, caches that are broken, places that cannot
// be written.

#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using strainwave::testing_support::text_of;

/// A folder with the seed gear on a coarse mesh, gear.toml, and a cache of its own.
class Environment : public testing::Test {
protected:
  struct End {
    int code;
    std::string out, err;
  };

  Environment() {
    std::string text = text_of(STRAINWAVE_SOURCE "/studies/gallery/seed.toml");
    text.resize(text.find("\n[mesh]"));
    write("gear.toml", text + "\n[mesh]\nper_pitch = 3\nalong_face = 2\nalong_wall = 2\ndiaphragm = 1\n"
                              "tooth_height = 1\n[load]\ntorque_nm = [7.0]\n");
  }

  void write(const std::string& name, const std::string& text) { temporary.write(name, text); }

  End run(const std::string& arguments, const std::string& environment = "") {
    const std::string command = fmt::format(
        "export STRAINWAVE_CACHE='{1}' && cd '{0}' && env {2} '{3}' {4} > out.txt 2> err.txt < /dev/null",
        folder.string(), cache.string(), environment, STRAINWAVE_PROGRAM, arguments);
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder / "out.txt"),
            text_of(folder / "err.txt")};
  }

  void expect(const End& end, int code, const std::string& err) {
    EXPECT_EQ(end.code, code) << end.err;
    EXPECT_EQ(end.err, err);
  }

  fs::path stored() { return fs::directory_iterator(cache)->path(); }

  strainwave::testing_support::TemporaryFolder temporary;
  fs::path folder = temporary.path, cache = folder / "cache";
};

TEST_F(Environment, FilesThatAreNoGearFilesAreNamed) {
  fs::create_directory(folder / "gears");
  expect(run("analyze gaer.toml"), 2, "strainwave: gaer.toml: no such gear file; did you mean gear.toml?\n");
  expect(run("analyze gears"), 2, "strainwave: gears: is a folder, not a gear file\n");
  write("program.toml", std::string("\x7f"
                                    "ELF\x02\x01\x00\x00\xff\xfe\x1b[2J",
                                    13));
  const End binary = run("analyze program.toml");
  EXPECT_EQ(binary.code, 2);
  EXPECT_TRUE(binary.err.starts_with("strainwave: program.toml:1:")) << binary.err;
  for (const char c : binary.err)
    EXPECT_TRUE(c == '\n' || (c >= ' ' || static_cast<unsigned char>(c) >= 0x80)) << binary.err;
}

TEST_F(Environment, FaultyShapeTableIsTheFilesFault) {
  std::string text = text_of(folder / "gear.toml");
  text.replace(text.find("shape = \"two_disc_exact\""), 24, "shape = \"table\"");
  const std::size_t old = text.find("table_file");
  text.replace(old, text.find('\n', old) - old, "table_file = \"shape.txt\"");
  const std::size_t e = text.find("eccentricity_mm");
  text.replace(e, text.find('\n', e) - e, "");
  write("gear.toml", text);
  const End missing = run("analyze gear.toml");
  EXPECT_EQ(missing.code, 2) << missing.err;
  EXPECT_NE(missing.err.find("wave_generator.table_file: "), std::string::npos) << missing.err;
  EXPECT_NE(missing.err.find("there is no file "), std::string::npos) << missing.err;
  write("shape.txt", "0 0.2\n90 one\n");
  for (const char* command : {"analyze gear.toml", "check gear.toml"}) {
    const End end = run(command);
    EXPECT_EQ(end.code, 2) << end.err;
    EXPECT_NE(end.err.find("shape.txt:2: 'one' is not a finite number"), std::string::npos) << end.err;
  }
}

TEST_F(Environment, CheckSaysWhatThisVersionCannotDo) {
  std::string text = text_of(folder / "gear.toml");
  const std::size_t line = text.find("fidelity = ");
  text.replace(line, text.find('\n', line) - line, "fidelity = \"nonlinear\"");
  write("gear.toml", text);
  for (const char* command : {"check gear.toml", "analyze gear.toml"}) {
    const End end = run(command);
    EXPECT_EQ(end.code, 3) << command;
    EXPECT_TRUE(end.err.starts_with(
        "strainwave: gear.toml: the nonlinear finite-element check is not in this version"))
        << end.err;
  }
  EXPECT_EQ(run("analyze gear.toml --only backlash").code, 0);
}

TEST_F(Environment, CacheThatCannotBeWrittenIsAWarning) {
  const std::string again = "; they will be computed again next time\n";
  cache = "/proc/strainwave";
  const End refused = run("analyze gear.toml");
  EXPECT_EQ(refused.code, 0) << refused.err;
  EXPECT_EQ(refused.err,
            "strainwave: the unit responses cannot be kept in /proc/strainwave: No such file or directory" +
                again);
  cache = folder / "gear.toml"; // a file
  const End file = run("analyze gear.toml");
  EXPECT_EQ(file.code, 0);
  EXPECT_EQ(file.err, fmt::format("strainwave: the unit responses cannot be kept in {}: Not a directory{}",
                                  cache.string(), again));
  EXPECT_EQ(refused.out.substr(0, refused.out.find("Stages")), file.out.substr(0, file.out.find("Stages")));
}

TEST_F(Environment, WithoutAHomeNothingIsKept) {
  const End end = run("analyze gear.toml", "-u STRAINWAVE_CACHE -u HOME -u XDG_CACHE_HOME");
  expect(end, 0, "");
}

TEST_F(Environment, BrokenAndForeignCacheFilesAreRebuilt) {
  const End first = run("analyze gear.toml");
  ASSERT_EQ(first.code, 0) << first.err;
  const std::string whole = text_of(stored()), name = "cache/" + stored().filename().string();
  const auto expect_rebuilt = [&](const std::string& reason) {
    const End end = run("analyze gear.toml");
    expect(end, 0,
           fmt::format("strainwave: {} is ignored: {}; the unit responses are computed again\n",
                       stored().string(), reason));
    EXPECT_EQ(end.out.substr(0, end.out.find("Stages")), first.out.substr(0, first.out.find("Stages")));
    expect(run("analyze gear.toml"), 0, ""); // whole again
  };
  write(name, whole.substr(0, whole.size() / 2));
  expect_rebuilt("it cannot be read as HDF5");
  write(name, "a shopping list");
  expect_rebuilt("it cannot be read as HDF5");
  write(name, "");
  expect_rebuilt("it cannot be read as HDF5");
  std::string flipped = whole; // in the middle: among the numbers
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 0x10);
  write(name, flipped);
  expect_rebuilt("it is damaged");
}

TEST_F(Environment, ResultThatCannotBeWrittenEndsWith74AndTheCause) {
  expect(run("analyze gear.toml -o nowhere/out.h5"), 74,
         "strainwave: cannot write nowhere/out.h5: No such file or directory\n");
  fs::create_directory(folder / "results");
  expect(run("analyze gear.toml -o results"), 74, "strainwave: cannot write results: Is a directory\n");
  expect(run("analyze gear.toml -o /proc/out.h5"), 74,
         "strainwave: cannot write /proc/out.h5: No such file or directory\n");
  EXPECT_TRUE(fs::is_empty(folder / "results"));
}

TEST_F(Environment, MeshThatDoesNotFitIsRefusedBeforeItIsMade) {
  std::string text = text_of(folder / "gear.toml");
  text.resize(text.find("\n[mesh]"));
  write("gear.toml", text + "\n[mesh]\nper_pitch = 64\nalong_face = 200\nalong_wall = 200\ndiaphragm = 200\n"
                            "tooth_height = 64\nthrough_thickness = 16\n");
  const End end = run("analyze gear.toml --no-cache");
  EXPECT_EQ(end.code, 74);
  EXPECT_TRUE(end.err.starts_with("strainwave: the finite elements of the flexspline (")) << end.err;
  EXPECT_NE(end.err.find("GB are available; take smaller counts in [mesh]"), std::string::npos) << end.err;
}

TEST_F(Environment, TheDocumentShowsOnlyWhatIsSaid) {
  fs::create_directory(folder / "gears");
  fs::create_directory(folder / "results");
  std::string said;
  for (const char* arguments : {"analyze gaer.toml", "analyze gears", "analyze gear.toml -o nowhere/out.h5",
                                "analyze gear.toml -o results"})
    said += run(arguments).err;
  std::istringstream page(text_of(STRAINWAVE_SOURCE "/docs/errors.md"));
  int shown = 0;
  bool here = false;
  for (std::string line; std::getline(page, line);) {
    here = here || line == "## Files, disk and memory";
    if (!here || !line.starts_with("strainwave: "))
      continue;
    ++shown;
    EXPECT_NE(said.find(line + "\n"), std::string::npos) << line;
  }
  EXPECT_EQ(shown, 4);
}

} // namespace
