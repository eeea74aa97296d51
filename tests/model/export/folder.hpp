#pragma once
// A folder of its own for a test, gone afterwards; and the seed gear on a mesh that solves in a moment.

#include "strainwave/model/gear/gear.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

namespace strainwave::testing_export {

class Folder {
public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "strainwave-export-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

inline Gear coarse_seed() {
  Gear gear = seed_gear();
  gear.mesh = {.per_pitch = 3,
               .along_face = 3,
               .along_wall = 4,
               .diaphragm = 3,
               .tooth_height = 1,
               .through_thickness = 1};
  gear.load.torque_nm = {1.0, 7.0};
  gear.load.rotation_rad = {};
  return gear;
}

} // namespace strainwave::testing_export
