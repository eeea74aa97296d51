// `export` and `analyze --plots` from the command line: what ends how, and with which sentence.

#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using strainwave::testing_support::TemporaryFolder;
using strainwave::testing_support::text_of;

/// The seed gear on a mesh that solves in a moment.
std::string coarse_seed() {
  std::string text = text_of(fs::path(STRAINWAVE_SOURCE) / "studies/gallery/seed.toml");
  text.resize(text.find("\n[mesh]"));
  return text + "\n[mesh]\nper_pitch = 3\nalong_face = 3\nalong_wall = 4\ndiaphragm = 3\ntooth_height = 1\n"
                "through_thickness = 1\n[load]\ntorque_nm = [7.0]\n";
}

class Export : public testing::Test {
protected:
  struct End {
    int code;
    std::string out, err;
  };
  Export() { temporary.write("gear.toml", coarse_seed()); }
  End run(const std::string& arguments, const std::string& environment = {}) {
    const int status = std::system(
        fmt::format("cd '{0}' && STRAINWAVE_CACHE='{0}/cache' {1} '{2}' {3} > out.txt 2> err.txt < /dev/null",
                    folder.string(), environment, STRAINWAVE_PROGRAM, arguments)
            .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder / "out.txt"),
            text_of(folder / "err.txt")};
  }
  TemporaryFolder temporary;
  fs::path folder = temporary.path;
};

TEST_F(Export, contact_problem_is_solved_by_another_program_to_the_same_forces) {
  if (std::system("/usr/bin/python3 -c 'import h5py, scipy' 2> /dev/null") != 0)
    GTEST_SKIP() << "needs python3-h5py and python3-scipy";
  std::ofstream(folder / "linearised.toml")
      << coarse_seed().replace(coarse_seed().find("disc_gap = \"exact\""),
                               std::string("disc_gap = \"exact\"").size(), "disc_gap = \"linearised\"");
  ASSERT_EQ(run("export linearised.toml --contact contact.h5").code, 0);
  const End analysed = run("analyze linearised.toml --json");
  ASSERT_EQ(analysed.code, 0) << analysed.err;
  std::ofstream(folder / "result.json") << analysed.out;
  // gap = q − θ r + M z, z ≥ 0 by non-negative least squares: min |L⁻¹(q − θ r) + Lᵀ z|, M = L Lᵀ
  std::ofstream(folder / "peer.py") << R"(
import h5py, json, numpy as np
from scipy.linalg import solve_triangular
from scipy.optimize import nnls
load = json.load(open("result.json"))["load"][0]
p = h5py.File("contact.h5")["phase_0"]
M, q, r = p["compliance"][:], p["gap"][:], p["lever"][:]
L = np.linalg.cholesky(M)
z, _ = nnls(L.T, -solve_triangular(L, q - load["rotation_rad"] * r, lower=True), maxiter=20000)
n = len(p["tooth"])
torque = 1e-3 * p["lobes"][0] * r @ z
assert abs(torque - load["torque_nm"]) < 1e-6, torque
theirs = dict(zip(load["tooth"], load["force_n"]))
for tooth, force in zip(p["tooth"][:], z[:n]):
    assert abs(theirs[int(tooth)] - force) < 1e-5, (tooth, force)
assert max(z[:n]) > 10
)";
  EXPECT_EQ(std::system(fmt::format("cd '{}' && /usr/bin/python3 peer.py", folder.string()).c_str()), 0);
}

TEST_F(Export, writes_every_kind_of_file_and_nothing_to_stdout) {
  const End end = run("export gear.toml --calculix cup.inp --vtkhdf cup.vtkhdf --profile teeth.dxf");
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.out, "");
  EXPECT_TRUE(text_of(folder / "cup.inp").starts_with("** Cup of the strain wave gear"));
  EXPECT_TRUE(text_of(folder / "cup.vtkhdf").starts_with("\x89HDF"));
  EXPECT_NE(text_of(folder / "teeth.dxf").find("POLYLINE"), std::string::npos);
  EXPECT_EQ(run("export gear.toml --profile teeth.csv --teeth 0 3 --points 5").code, 0);
  EXPECT_TRUE(text_of(folder / "teeth.csv").starts_with("outline,tooth"));
  for (const auto& entry : fs::directory_iterator(folder))
    EXPECT_NE(entry.path().extension(), ".part");
}

TEST_F(Export, deck_can_carry_the_contact_forces) {
  const End end = run("export gear.toml --calculix cup.inp --contact-forces");
  EXPECT_EQ(end.code, 0) << end.err;
  const std::string deck = text_of(folder / "cup.inp");
  EXPECT_NE(deck.find("** Step 1: assembled\n** Step 2: loaded_7Nm\n"), std::string::npos);
}

TEST_F(Export, nothing_asked_for_and_unknown_endings_are_wrong_use) {
  EXPECT_EQ(run("export gear.toml").code, 2);
  const End end = run("export gear.toml --profile teeth.step");
  EXPECT_EQ(end.code, 2);
  EXPECT_NE(end.err.find("must end in .dxf or .csv"), std::string::npos) << end.err;
}

TEST_F(Export, places_that_cannot_be_written_end_with_74_and_the_cause) {
  for (const char* option : {"--calculix", "--vtkhdf", "--profile"}) {
    const std::string name = std::string(option) == "--profile" ? "t.csv" : "t";
    const End end = run(fmt::format("export gear.toml {} nowhere/{}", option, name));
    EXPECT_EQ(end.code, 74) << option;
    EXPECT_NE(end.err.find("cannot write nowhere/" + name + ": No such file or directory"), std::string::npos)
        << end.err;
  }
  fs::create_directory(folder / "dir.csv");
  const End end = run("export gear.toml --profile dir.csv");
  EXPECT_EQ(end.code, 74);
  EXPECT_NE(end.err.find("Is a directory"), std::string::npos) << end.err;
}

TEST_F(Export, full_disk_ends_with_74_and_leaves_nothing_beside) {
  if (!fs::exists("/dev/full"))
    GTEST_SKIP();
  fs::create_symlink("/dev/full", folder / "cup.inp");
  const End end = run("export gear.toml --calculix cup.inp");
  EXPECT_EQ(end.code, 74);
  EXPECT_NE(end.err.find("No space left"), std::string::npos) << end.err;
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  for (const auto& entry : fs::directory_iterator(folder))
    EXPECT_NE(entry.path().extension(), ".part");
}

/// The coarse seed gear with another value of one key, at its first place.
std::string changed(const std::string& key, const std::string& value) {
  std::string text = coarse_seed();
  const std::size_t at = text.find("\n" + key) + 1;
  return text.replace(at, text.find('\n', at) - at, key + " = " + value);
}

TEST_F(Export, gear_that_contradicts_itself_ends_with_3_and_writes_nothing) {
  std::ofstream(folder / "bad.toml") << changed("tip_radius_mm", "15.6"); // no tooth is left up there
  for (const char* what : {"--calculix x.inp", "--vtkhdf x.vtkhdf", "--profile x.dxf"}) {
    const End end = run(fmt::format("export bad.toml {}", what));
    EXPECT_EQ(end.code, 3) << what << end.err;
    EXPECT_NE(end.err.find("strainwave: "), std::string::npos);
  }
  for (const char* name : {"x.inp", "x.vtkhdf", "x.dxf"})
    EXPECT_FALSE(fs::exists(folder / name));
}

TEST_F(Export, output_that_would_replace_the_gear_file_is_refused) {
  std::ofstream(folder / "mine.toml") << changed("profile_shift", "2.13");
  const std::string before = text_of(folder / "mine.toml");
  for (const char* what : {"export mine.toml --vtkhdf mine.toml", "export mine.toml --calculix ./mine.toml",
                           "analyze mine.toml -o mine.toml"}) {
    const End end = run(what);
    EXPECT_EQ(end.code, 2) << what;
    EXPECT_NE(end.err.find("would be replaced"), std::string::npos) << end.err;
    EXPECT_EQ(text_of(folder / "mine.toml"), before) << what;
  }
}

TEST_F(Export, wave_generator_without_wrap_has_no_fields_and_no_profile_but_a_deck_of_its_cup) {
  std::ofstream(folder / "bad.toml") << changed("max_radial_deformation_mm", "0.1"); // e/u0 = 6
  EXPECT_EQ(run("export bad.toml --vtkhdf x.vtkhdf").code, 3);
  EXPECT_EQ(run("export bad.toml --profile x.dxf").code, 3);
  EXPECT_EQ(run("export bad.toml --calculix x.inp").code, 0);
}

TEST_F(Export, options_that_nothing_would_read_are_named) {
  const std::pair<const char*, const char*> cases[] = {
      {"--profile teeth.csv --tooth 2",
       "--tooth has no effect here; it belongs to --calculix without --contact-forces"},
      {"--calculix cup.inp --contact-forces --height 0.7", "--height has no effect here"},
      {"--calculix cup.inp --torque-nm 7",
       "--torque-nm has no effect here; it belongs to --vtkhdf, or --calculix with"},
      {"--vtkhdf cup.vtkhdf --zeta 0.5", "--zeta has no effect here; it belongs to --profile"},
      {"--profile teeth.csv --contact-forces",
       "--contact-forces has no effect here; it belongs to --calculix"}};
  for (const auto& [options, sentence] : cases) {
    const End end = run(fmt::format("export gear.toml {}", options));
    EXPECT_EQ(end.code, 2) << options;
    EXPECT_NE(end.err.find(sentence), std::string::npos) << end.err;
  }
  EXPECT_FALSE(fs::exists(folder / "teeth.csv"));
}

TEST_F(Export, gallery_gears_of_the_whole_flank_are_free_as_they_stand) {
  const std::string gallery = STRAINWAVE_SOURCE "/studies/gallery/";
  EXPECT_EQ(run("check " + gallery + "seed_flank.toml").code, 0);
  EXPECT_EQ(run("check " + gallery + "seed_coned.toml").code, 0);
  // the backlash map does not hang on the points; x2 has four decimals, each 0.01 µm
  std::string text = text_of(fs::path(gallery) / "seed_coned.toml");
  text.replace(text.find("flank_points = 9"), 16, "flank_points = 1");
  text.replace(text.find("face_slices = 9"), 15, "face_slices = 1");
  std::ofstream(folder / "coned.toml") << text;
  const End end = run("analyze coned.toml --json --only compliance");
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_NE(end.out.find("\"interference\": false"), std::string::npos);
  const std::size_t map = end.out.find("\"min_um\"", end.out.find("\"assembled\""));
  ASSERT_NE(map, std::string::npos);
  EXPECT_NEAR(std::stod(end.out.substr(end.out.find(':', map) + 1)), 1.0, 0.05);
}

TEST_F(Export, analyze_tries_its_places_before_it_computes) {
  for (const char* options : {"-o nowhere/out.h5", "-o .", "--plots gear.toml/x"}) {
    const End end = run(fmt::format("analyze gear.toml {}", options));
    EXPECT_EQ(end.code, 74) << options;
    EXPECT_EQ(end.out, "") << options; // the table comes after the computation
  }
  fs::create_directory(folder / "plots");
  fs::create_directory(folder / "plots/initial-backlash.dat");
  EXPECT_EQ(run("analyze gear.toml --plots plots").out, "");
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    EXPECT_NE(entry.path().extension(), ".part");
}

TEST_F(Export, analyze_path_prints_every_tooth_that_joins_and_agrees_with_the_direct_solution) {
  const End plain = run("analyze gear.toml");
  const End end = run("analyze gear.toml --path");
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(plain.out.find("Load path"), std::string::npos);
  EXPECT_NE(end.out.find("Load path       phase 0, drive, wall gaps linearised about the assembled cup"),
            std::string::npos)
      << end.out;
  EXPECT_NE(end.out.find("rest, no tooth carries"), std::string::npos) << end.out;
  EXPECT_NE(end.out.find("joins"), std::string::npos) << end.out;
  EXPECT_NE(end.out.find("at 7 N·m"), std::string::npos) << end.out;
  EXPECT_NE(end.out.find("the exact disc gap turns it by"), std::string::npos) << end.out;
  const End json = run("analyze gear.toml --path --json -o result.h5");
  EXPECT_EQ(json.code, 0);
  EXPECT_NE(json.out.find("\"path\": {"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "result.h5"));
  const End early = run("analyze gear.toml --path --only backlash");
  EXPECT_EQ(early.code, 2);
  EXPECT_EQ(early.out, "");
  EXPECT_NE(early.err.find("--path needs the loads"), std::string::npos) << early.err;
}

TEST_F(Export, analyze_draws_plots_or_says_why_not) {
  const End without = run("analyze gear.toml --plots plain", "PATH=/nonexistent");
  EXPECT_EQ(without.code, 0) << without.err;
  EXPECT_NE(without.err.find("gnuplot is not installed"), std::string::npos) << without.err;
  EXPECT_TRUE(fs::exists(folder / "plain/meshing-forces.dat"));
  EXPECT_FALSE(fs::exists(folder / "plain/meshing-forces.svg"));
  const End into_file = run("analyze gear.toml --plots gear.toml/x");
  EXPECT_EQ(into_file.code, 74) << into_file.err;
  if (std::system("command -v gnuplot > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "gnuplot (package gnuplot-nox) is not installed";
  const End end = run("analyze gear.toml --plots plots");
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.err, "");
  for (const char* name :
       {"initial-backlash", "meshing-forces", "loaded-backlash", "torque-rotation", "assembled-shape"})
    EXPECT_GT(fs::file_size(folder / "plots" / (std::string(name) + ".svg")), 1000u) << name;
}

} // namespace
