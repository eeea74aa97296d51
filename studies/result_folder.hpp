#pragma once
// The folder of a study. Every file is written beside its place and renamed into it, so a reader never sees
// half of one.
//
//   plan.json     what is to be done: the resolved study, the gear, hash; written before the first evaluation
//   results.h5    every evaluation, see results_file.hpp
//   result.json   what `study run --json` prints
//   best.toml     the optimised gear; `analyze` and `check` read it

#include "studies/optimisation.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace strainwave {

class ResultFolder {
public:
  /// Makes the folder. Throws std::filesystem::filesystem_error, std::system_error.
  explicit ResultFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  /// Why this folder is not to be written by this study: it holds the results of another one, or other files. Empty: it may.
  std::string occupied(const StudyFile& study) const;
  void write_plan(const StudyFile& study) const;
  /// False, and nothing written, when the run was stopped early and the folder already has a finished result.
  bool write_results(const OptimisationReport& report) const;

private:
  void write_text(const char* name, std::string_view text) const;

  std::filesystem::path path_;
};

/// Identifies a study: its resolved text, the bits of its gear, and the program's version.
std::string plan_hash(const StudyFile& study);

/// "./seed_optimize-result" for studies/gallery/seed_optimize.toml, "…-reduced-result" for a reduced one.
std::filesystem::path default_result_folder(const StudyFile& study);

} // namespace strainwave
