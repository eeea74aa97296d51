#pragma once
// Files and edits for these tests.

#include "strainwave/model/gear_file/gear_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace strainwave {

inline const std::string seed_path = STRAINWAVE_SOURCE "/studies/gallery/seed.toml";

inline std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The text with the first `before` replaced. Fails the test if there is none.
inline std::string edited(std::string text, const std::string& before, const std::string& after) {
  const std::size_t place = text.find(before);
  if (place == std::string::npos) {
    ADD_FAILURE() << "nothing to replace: " << before;
    return text;
  }
  return text.replace(place, before.size(), after);
}

/// What FileError says about a text called gear.toml; "no error" if it is a gear.
inline std::string complaint_about(const std::string& text) {
  try {
    (void)parse_gear(text, "gear.toml");
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

using testing_support::TemporaryFolder;

} // namespace strainwave
