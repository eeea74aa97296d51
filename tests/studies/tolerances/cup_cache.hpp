#pragma once
// Rows whose cup is solved once for a test program, in a cache of its own.

#include "strainwave/studies/tables/row_study.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <unistd.h>

namespace strainwave {

inline RunContext cup_cache() {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / fmt::format("strainwave-samples-{}", getpid());
    Folder() { setenv("STRAINWAVE_CACHE", path.c_str(), 1); }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return {};
}

} // namespace strainwave
