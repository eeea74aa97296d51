// The exact words for every kind of fault. They are written for gear engineers: read them aloud before
// changing one. docs/errors.md shows some of them; it may show only what stands here.

#include "tests/model/gear_file/files.hpp"

#include <set>
#include <vector>

namespace strainwave {
namespace {

/// The seed gear's file with one edit, and everything that is then said about it.
struct Golden {
  const char* title;
  std::string before;
  std::string after;
  std::string message;
};

const std::string module_line = "module_mm = 0.2 ";
const std::string shape_line = "shape = \"two_disc_exact\"";
const std::string torque_line = "torque_nm = [1.0, 7.0, 11.5]";
const std::string name_line = "name = \"seed 140/142\"";

const std::vector<Golden>& goldens() {
  static const std::vector<Golden> all{
      {"misspelt key", module_line, "modul_mm = 0.2 ",
       "gear.toml:13:1: flexspline.modul_mm: no such key; did you mean module_mm?"},
      {"key without its unit", module_line, "module = 0.2 ",
       "gear.toml:13:1: flexspline.module: no such key; did you mean module_mm?"},
      {"unrelated key", "name = ", "colour = \"red\"\nname = ",
       "gear.toml:6:1: colour: no such key; the nearest legal key is name"},
      {"key in the wrong table", "[material] ", "[material]\nface_width_mm = 6.0 #",
       "gear.toml:9:1: material.face_width_mm: no such key here; face_width_mm belongs to [flexspline]"},
      {"key above all tables", name_line, "module_mm = 0.2",
       "gear.toml:6:1: module_mm: no such key here; module_mm belongs to [flexspline]"},
      {"misspelt key above all tables", name_line, "modul_mm = 0.2",
       "gear.toml:6:1: modul_mm: no such key here; did you mean module_mm in [flexspline]?"},
      {"name in a table", "[material] ", "[material]\nname = \"x\" #",
       "gear.toml:9:1: material.name: no such key here; name stands at the top, above all tables"},
      {"misspelt table", "[flexspline] ", "[flexpline] ",
       "gear.toml:12:2: flexpline: no such table; did you mean [flexspline]?"},
      {"unknown table", "[mesh] ", "[bearings] ",
       "gear.toml:85:2: bearings: no such table; the nearest legal one is [material]"},
      {"table in double brackets", "[flexspline] ", "[[flexspline]] ",
       "gear.toml:12:3: flexspline: this table is opened with single brackets: [flexspline]"},
      {"missing key", module_line, "# ",
       "gear.toml:12:1: flexspline.module_mm: missing in the table [flexspline]; expected a number in mm, "
       "above 0 and at "
       "most 100: module of both members"},
      {"number as text", module_line, "module_mm = \"0.2\" ",
       "gear.toml:13:13: flexspline.module_mm: expected a number in mm, above 0 and at most 100, got the "
       "text \"0.2\"; "
       "remove the quotes"},
      {"list for a number", module_line, "module_mm = [0.2] ",
       "gear.toml:13:13: flexspline.module_mm: expected a number in mm, above 0 and at most 100, got a list"},
      {"decimal number of teeth", "teeth = 140", "teeth = 140.0",
       "gear.toml:15:9: flexspline.teeth: expected a whole number, at least 8 and at most 2000, got the "
       "number 140; write "
       "it without a decimal point"},
      {"number for a list", torque_line, "torque_nm = 7.0",
       "gear.toml:94:13: load.torque_nm: expected a list of numbers in N·m, each at least 0 and at most "
       "1000000, got the "
       "number 7; write [7]"},
      {"text in a list", torque_line, "torque_nm = [1.0, \"7\"]",
       "gear.toml:94:19: load.torque_nm: expected only numbers in the list, got the text \"7\""},
      {"number below its range", module_line, "module_mm = -0.2 ",
       "gear.toml:13:13: flexspline.module_mm: must be above 0 and at most 100 mm, is -0.2"},
      {"whole number beyond its range", "teeth = 140", "teeth = 99999999999",
       "gear.toml:15:9: flexspline.teeth: must be at least 8 and at most 2000, is 99999999999"},
      {"modulus in pascals", "206000.0", "206e9",
       "gear.toml:9:22: material.youngs_modulus_mpa: must be at least 1 and at most 2000000 MPa, is "
       "206000000000"},
      {"list item out of range", torque_line, "torque_nm = [1.0, -7.0]",
       "gear.toml:94:19: load.torque_nm: every number of the list must be at least 0 and at most 1000000 "
       "N·m, is -7"},
      {"window of one angle", "window_deg = []", "window_deg = [-21.0]",
       "gear.toml:77:14: contact.window_deg: must hold 2 numbers or none, holds 1"},
      {"window backwards", "window_deg = []", "window_deg = [51.0, -21.0]",
       "gear.toml:77:21: contact.window_deg: the numbers must rise, but -21 follows 51"},
      {"not a number", module_line, "module_mm = nan ",
       "gear.toml:13:13: flexspline.module_mm: must be a finite number, is nan"},
      {"infinite number", module_line, "module_mm = -inf ",
       "gear.toml:13:13: flexspline.module_mm: must be a finite number, is -inf"},
      {"misspelt choice", shape_line, "shape = \"two-disk\"",
       "gear.toml:35:9: wave_generator.shape: must be two_disc, two_disc_exact, four_force, ellipse, cosine "
       "or table, is "
       "\"two-disk\"; did you mean \"two_disc\"?"},
      {"unknown choice", shape_line, "shape = \"hydraulic\"",
       "gear.toml:35:9: wave_generator.shape: must be two_disc, two_disc_exact, four_force, ellipse, cosine "
       "or table, is "
       "\"hydraulic\""},
      {"missing table file", "table_file = \"\"", "table_file = \"/no/such/curve.txt\"",
       "gear.toml:42:14: wave_generator.table_file: there is no file /no/such/curve.txt"},
      {"table without its file", shape_line, "shape = \"table\"",
       "gear.toml:35:9: wave_generator.shape: the shape \"table\" needs table_file, the file that holds the "
       "curve"},
      {"key given twice", module_line, "module_mm = 0.2\nmodule_mm = 0.3 ",
       "gear.toml:14:1: flexspline.module_mm: the key is given twice (first in line 13); keep one of the "
       "two"},
      {"table opened twice", "[flexspline] ", "[material] ",
       "gear.toml:12:1: material: the table [material] is opened twice (first in line 8); put its keys "
       "together"},
      {"table and key of one name", name_line, "flexspline = 3",
       "gear.toml:12:1: flexspline: [flexspline] opens a table, but a key of this name stands above"},
      {"decimal comma", module_line, "module_mm = 0,2 ",
       "gear.toml:13:14: flexspline.module_mm: a decimal number is written with a point: 0.2"},
      {"unit after the number", module_line, "module_mm = 0.2 mm ",
       "gear.toml:13:17: flexspline.module_mm: a number stands without its unit, which is in the key's name: "
       "0.2"},
      {"colon for equals", module_line, "module_mm: 0.2 ",
       "gear.toml:13:10: flexspline.module_mm: a key and its value are joined by =, as in  module_mm = 0.2"},
      {"no digit before the point", module_line, "module_mm = -.2 ",
       "gear.toml:13:14: flexspline.module_mm: a number begins with a digit: -0.2"},
      {"no digit after the point", module_line, "module_mm = 2. ",
       "gear.toml:13:15: flexspline.module_mm: a number has a digit after the point: 2.0"},
      {"zeros in front", module_line, "module_mm = 00.2 ",
       "gear.toml:13:14: flexspline.module_mm: a number has no zeros in front: 0.2"},
      {"fraction", module_line, "module_mm = 1/5 ",
       "gear.toml:13:14: flexspline.module_mm: the value cannot be read as a number; numbers are written "
       "like 0.2, -3 or "
       "1e-3"},
      {"value missing", module_line,
       "module_mm = ", "gear.toml:13:35: flexspline.module_mm: the value is missing after ="},
      {"foreign comment sign", name_line, "% a comment", "gear.toml:6:1: a comment begins with #"},
      {"foreign comment after a value", module_line, "module_mm = 0.2 // mm #",
       "gear.toml:13:17: flexspline.module_mm: a comment begins with #"},
      {"text without quotes", shape_line, "shape = two_disc",
       "gear.toml:35:10: wave_generator.shape: a text stands in quotes: \"two_disc\""},
      {"typographic quotes", shape_line, "shape = “two_disc”",
       "gear.toml:35:9: wave_generator.shape: a text stands in plain quotes: \"…\""},
      {"text not closed", name_line + "   ", "name = \"seed ",
       "gear.toml:6:82: name: the text is not closed; it ends with \""},
      {"heading not closed", "[flexspline] ", "[flexspline ",
       "gear.toml:12:38: a table's heading ends with ]"},
      {"heading not opened", "[flexspline] ", "flexspline] ",
       "gear.toml:12:11: a table's heading begins with ["},
      {"list not closed", torque_line, "torque_nm = [1.0, 7.0",
       "gear.toml:94:1: load.torque_nm: the numbers of a list are separated by commas, and the list ends "
       "with ]"},
      {"list without commas", torque_line, "torque_nm = [1.0 7.0]",
       "gear.toml:94:18: load.torque_nm: the numbers of a list are separated by commas, and the list ends "
       "with ]"},
  };
  return all;
}

TEST(GearFileMessages, AreExactlyThese) {
  const std::string seed = file_text(seed_path);
  for (const Golden& golden : goldens())
    EXPECT_EQ(complaint_about(edited(seed, golden.before, golden.after)), golden.message) << golden.title;
}

TEST(GearFileMessages, AllFaultsOfAFileComeTogetherInOrder) {
  std::string text = file_text(seed_path);
  text = edited(text, "poisson_ratio = 0.3", "poisson_ratio = 0.7");
  text = edited(text, "[flexspline] ", "[flexspline]\nteehts = 140 #");
  text = edited(text, "teeth = 140", "#");
  text = edited(text, "root_radius_mm = 14.86", "#");
  text = edited(text, "phases = 1", "phase = 1");
  EXPECT_EQ(complaint_about(text),
            "gear.toml:10:17: material.poisson_ratio: must be at least 0 and below 0.5, is 0.7\n"
            "gear.toml:13:1: flexspline.teehts: no such key; did you mean teeth?\n"
            "gear.toml:29:1: circular_spline.root_radius_mm: missing in the table [circular_spline]; "
            "expected a number in "
            "mm, above 0 and at most 1000: radius of the root circle (the outer one)\n"
            "gear.toml:99:1: load.phase: no such key; did you mean phases?");
}

TEST(GearFileMessages, FaultsCarryTheirPartsForPrograms) {
  try {
    (void)parse_gear(edited(file_text(seed_path), module_line, "modul_mm = 0.2 "), "gear.toml");
    FAIL();
  } catch (const FileError& error) {
    ASSERT_EQ(error.faults().size(), 1u);
    EXPECT_EQ(error.file(), "gear.toml");
    EXPECT_EQ(error.faults()[0].place, (Place{13, 1}));
    EXPECT_EQ(error.faults()[0].key, "flexspline.modul_mm");
    EXPECT_EQ(error.faults()[0].nearest, "flexspline.module_mm");
  }
}

TEST(GearFileMessages, EmptyAndForeignFiles) {
  EXPECT_EQ(complaint_about("# only a comment\n"),
            "gear.toml:1:1: the file gives no key; `strainwave example` prints a complete gear file");
  EXPECT_EQ(complaint_about("{ \"name\": 1 }"),
            "gear.toml:1:1: this is not TOML (JSON, perhaps); `strainwave example` prints a gear file");
  EXPECT_EQ(complaint_about("name = \"gr\xfc\xdf\""),
            "gear.toml:1:10: not a text file in UTF-8; save it in that encoding");
}

TEST(GearFileMessages, MissingTablesAreNamedWithTheirKeys) {
  EXPECT_NE(
      complaint_about("name = \"x\"")
          .find(
              "gear.toml:1:1: circular_spline: the table [circular_spline] is missing; it has to give teeth, "
              "profile_shift, tip_radius_mm, root_radius_mm"),
      std::string::npos);
}

TEST(GearFileMessages, MissingFileNamesItsNeighbour) {
  const TemporaryFolder folder;
  folder.write("seed.toml", "");
  try {
    (void)load_gear((folder / "sed.toml").string());
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(error.what(), (folder / "sed.toml").string() + ": no such gear file; did you mean " +
                                (folder / "seed.toml").string() + "?");
  }
}

TEST(GearFileMessages, FolderIsNoGearFile) {
  const TemporaryFolder folder;
  try {
    (void)load_gear((folder / "").string());
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(error.what(), (folder / "").string() + ": is a folder, not a gear file");
  }
}

TEST(GearFileMessages, TheDocumentShowsOnlyWhatIsSaid) {
  std::set<std::string> said;
  for (const Golden& golden : goldens())
    said.insert(golden.message);
  std::istringstream page(file_text(STRAINWAVE_SOURCE "/docs/errors.md"));
  int shown = 0;
  const std::string start = "strainwave: gear.toml:";
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with(start))
      continue;
    ++shown;
    EXPECT_TRUE(said.contains(line.substr(std::string("strainwave: ").size()))) << line;
  }
  EXPECT_GE(shown, 10);
}

} // namespace
} // namespace strainwave
