// Damaged files: never a crash, always a gear or a FileError that names a place in the file.

#include "strainwave/model/gear/fields.hpp"
#include "tests/model/gear_file/files.hpp"

#include <algorithm>

namespace strainwave {
namespace {

void expect_gear_or_file_error(const std::string& text, std::size_t byte) {
  try {
    const Gear gear = parse_gear(text, "gear.toml").gear;
    for (const Field& field : gear_fields())
      EXPECT_FALSE(find_complaint(field, field.read(gear))) << field.path;
  } catch (const FileError& error) {
    const int lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    ASSERT_FALSE(error.faults().empty());
    for (const FileFault& fault : error.faults()) {
      EXPECT_FALSE(fault.sentence.empty());
      EXPECT_TRUE(fault.place.line >= 1 && fault.place.line <= lines && fault.place.column >= 1)
          << "byte " << byte << ": " << error.what();
    }
  } // anything else fails the test
}

TEST(GearFileMutation, TruncatedFiles) {
  const std::string seed = file_text(seed_path);
  for (std::size_t byte = 0; byte < seed.size(); byte += 50)
    expect_gear_or_file_error(seed.substr(0, byte), byte);
}

TEST(GearFileMutation, OneByteReplaced) {
  const std::string seed = file_text(seed_path);
  for (std::size_t byte = 0; byte < seed.size(); byte += 50)
    for (const char other :
         {'"', '\'', '[', ']', '=', '.', '\n', '#', '{', '9', '-', 'e', '\0', '\x80', '\xff'}) {
      std::string text = seed;
      text[byte] = other;
      expect_gear_or_file_error(text, byte);
    }
}

TEST(GearFileMutation, PiecesRemovedAndDoubled) {
  const std::string seed = file_text(seed_path);
  for (std::size_t byte = 0; byte + 50 < seed.size(); byte += 50) {
    expect_gear_or_file_error(seed.substr(0, byte) + seed.substr(byte + 50), byte);
    expect_gear_or_file_error(seed.substr(0, byte + 50) + seed.substr(byte), byte);
  }
}

TEST(GearFileMutation, DeepAndLongRubbish) {
  expect_gear_or_file_error("a = " + std::string(100000, '['), 0);
  expect_gear_or_file_error("a" + std::string(100000, '.') + "b = 1", 0);
  expect_gear_or_file_error(std::string(100000, 'a') + " = 1", 0);
  expect_gear_or_file_error("name = \"" + std::string(1000000, 'x') + "\"", 0);
  expect_gear_or_file_error(std::string(100000, '\n') + "x", 0);
}

} // namespace
} // namespace strainwave
