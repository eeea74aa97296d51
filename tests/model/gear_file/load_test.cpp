// Gear files that are right: what is read is what stands there.

#include "strainwave/model/gear/fields.hpp"
#include "tests/model/gear_file/files.hpp"

#include "strainwave/model/gear_file/field_reader.hpp"

#include <set>

namespace strainwave {
namespace {

TEST(GearFileLoad, SeedFileIsTheSeedGearBitForBit) {
  const GearDocument document = load_gear(seed_path);
  EXPECT_EQ(document.gear.name, seed_gear().name);
  EXPECT_EQ(canonical_bits(document.gear), canonical_bits(seed_gear()));
}

TEST(GearFileLoad, SeedFileShowsEveryKeyWithItsOrigin) {
  std::istringstream lines(file_text(seed_path));
  std::string text, table;
  std::set<std::string> shown;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("["))
      table = line.substr(1, line.find(']') - 1) + ".";
    const std::size_t equals = line.find(" = ");
    if (line.starts_with("#")
            ? line.find(" = ") == std::string::npos || line.find("assumed; ") == std::string::npos
            : equals == std::string::npos)
      continue;
    const std::size_t start = line.starts_with("# ") ? 2 : 0;
    shown.insert(table + line.substr(start, equals - start));
    EXPECT_TRUE(line.find("# assumed; ") != std::string::npos ||
                line.find("# source text; ") != std::string::npos)
        << line;
  }
  for (const Field& field : gear_fields())
    EXPECT_TRUE(shown.contains(std::string(field.path))) << field.path;
  EXPECT_EQ(shown.size(), gear_fields().size());
}

TEST(GearFileLoad, WholeNumbersAreNumbers) {
  const std::string text = edited(file_text(seed_path), "cup_length_mm = 28.0", "cup_length_mm = 28");
  EXPECT_EQ(canonical_bits(parse_gear(text, "gear.toml").gear), canonical_bits(seed_gear()));
}

TEST(GearFileLoad, DottedKeysAndInlineTablesAreToml) {
  std::string text = edited(file_text(seed_path), "[material] ", "#");
  text = edited(text, "youngs_modulus_mpa = 206000.0",
                "material = { youngs_modulus_mpa = 206000.0, poisson_ratio = 0.3 }");
  text = edited(text, "poisson_ratio = 0.3  ", "#");
  EXPECT_EQ(canonical_bits(parse_gear(text, "gear.toml").gear), canonical_bits(seed_gear()));
}

TEST(GearFileLoad, WindowsLineEndsAndByteOrderMarkAreFine) {
  std::string text = "\xef\xbb\xbf";
  for (const char letter : file_text(seed_path))
    text += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  EXPECT_EQ(canonical_bits(parse_gear(text, "gear.toml").gear), canonical_bits(seed_gear()));
}

TEST(GearFileLoad, KeysThatAreLeftOutHaveTheirDefaults) {
  const std::string whole = file_text(seed_path);
  const std::string text =
      whole.substr(0, whole.find("[flank_modification.flexspline]")); // no contact, mesh, load
  const Gear gear = parse_gear(text, "gear.toml").gear;
  EXPECT_EQ(gear.mesh.per_pitch, Mesh{}.per_pitch);
  EXPECT_TRUE(gear.load.torque_nm.empty());
}

TEST(GearFileLoad, AFormerNameIsReadAndSaidWhatItMeansNow) {
  const std::string text = edited(file_text(seed_path), "\"direct\"", "\"event_path\"");
  const GearDocument document = parse_gear(text, "gear.toml");
  EXPECT_EQ(document.gear.contact.method, LoadMethod::direct);
  EXPECT_EQ(canonical_bits(document.gear), canonical_bits(seed_gear()));
  ASSERT_EQ(document.warnings.size(), 1U);
  EXPECT_EQ(document.warnings[0],
            "gear.toml:75:10: contact.method: \"event_path\" is called \"direct\" now: every load is solved "
            "directly at its torque or rotation; `analyze --path` gives the path from event to event");
  EXPECT_TRUE(parse_gear(file_text(seed_path), "gear.toml").warnings.empty());
}

TEST(GearFileLoad, PlacesOfKeysAreKept) {
  const GearDocument document = parse_gear("# one\n" + file_text(seed_path), "gear.toml");
  EXPECT_EQ(document.where("flexspline.module_mm"), "gear.toml:14:1");
  EXPECT_EQ(document.where("wave_generator.wrap_angle_deg"), "gear.toml"); // not given
}

TEST(GearFileLoad, TableFileIsLookedForBesideTheGearFile) {
  const TemporaryFolder folder;
  folder.write("curve.txt", "0 0.2\n");
  const std::string path = folder.write(
      "gear.toml", edited(file_text(seed_path), "table_file = \"\"", "table_file = \"./curve.txt\""));
  EXPECT_EQ(load_gear(path).gear.wave_generator.table_file, (folder / "curve.txt").string());
}

TEST(GearFileLoad, TorquesAndRotationsMayStandTogether) {
  const std::string text = edited(file_text(seed_path), "rotation_rad = []", "rotation_rad = [1e-3]");
  const Gear gear = parse_gear(text, "gear.toml").gear;
  EXPECT_EQ(gear.load.torque_nm.size(), 3u);
  EXPECT_EQ(gear.load.rotation_rad, std::vector<double>{1e-3});
}

TEST(GearFileOverrides, QuotedPathsTablesAndListItemsAreWritten) {
  const toml::table table = parse_toml("\"contact.gaps\" = \"assembled\"\n"
                                       "wave_generator.max_radial_deformation_mm = 0.195\n"
                                       "load.torque_nm = [1, 2]\n"
                                       "\"load.torque_nm[1]\" = 3\n",
                                       "study.toml");
  Gear gear = seed_gear();
  std::vector<FileFault> faults;
  apply_overrides(gear, *table.as_table(), "", faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(gear.contact.gaps, GapModel::assembled);
  EXPECT_EQ(gear.wave_generator.max_radial_deformation_mm, 0.195);
  EXPECT_EQ(gear.load.torque_nm, (std::vector<double>{1.0, 3.0}));
}

TEST(GearFileOverrides, FaultsHaveTheirPlaces) {
  const toml::table table = parse_toml("\"contact.gap\" = \"assembled\"\n"
                                       "\"flexspline.module_mm\" = -1\n"
                                       "\"load.torque_nm[7]\" = 3\n"
                                       "flexspline = 3\n",
                                       "study.toml");
  Gear gear = seed_gear();
  std::vector<FileFault> faults;
  apply_overrides(gear, *table.as_table(), "", faults);
  EXPECT_STREQ(
      FileError("study.toml", faults).what(),
      "study.toml:1:1: contact.gap: no such key; did you mean gaps?\n"
      "study.toml:2:26: flexspline.module_mm: must be above 0 and at most 100 mm, is -1\n"
      "study.toml:3:23: load.torque_nm[7]: this gear's list holds only 3 numbers, counted from 0\n"
      "study.toml:4:1: flexspline: is a table of the gear file, expected keys in it, got the number 3");
  EXPECT_EQ(canonical_bits(gear), canonical_bits(seed_gear()));
}

} // namespace
} // namespace strainwave
