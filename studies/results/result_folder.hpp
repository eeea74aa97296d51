#pragma once
// The folder of a study. Every file is written beside its place, synced and renamed into it, so a reader
// never sees half of one.
//
//   plan.json     what is to be done: the resolved study, the gear, hash; written before the first
//   evaluation, then
//                 never again
//   shards/       the journals: the truth about what has been evaluated
//   results.h5    every evaluation, derived from the journals; see journal/results_table.hpp
//   result.json   what `study run --json` prints
//   best.toml     optimize, pareto: the optimised gear; `analyze` and `check` read it

#include "strainwave/studies/file/study.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace strainwave {

class ResultFolder {
public:
  /// Makes the folder. Throws std::filesystem::filesystem_error, std::system_error.
  explicit ResultFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  /// Why this folder is not to be written by this study: it holds the results of another one, or other files.
  /// Empty: it may.
  std::string occupied(const StudyFile& study) const;
  /// Nothing where the same plan is there already.
  void write_plan(const StudyFile& study) const;
  void write_text(const char* name, std::string_view text) const;
  /// DIR/shards/IIII-of-NNNN.journal; makes the folder of the shards.
  std::filesystem::path journal(std::uint32_t shard = 0, std::uint32_t shards = 1) const;

private:
  std::filesystem::path path_;
};

/// The `verdict` of DIR/result.json; empty where there is none.
std::string known_verdict(const std::filesystem::path& folder);

/// The study of a folder, from plan.json alone. Throws FileError where there is no plan or one of another
/// version of the program.
StudyFile read_plan(const std::filesystem::path& folder, StudyKinds kinds);

/// Identifies a study: its resolved text (without the place of the gear file), the bits of its gear, and the
/// program's version.
std::uint64_t plan_hash(const StudyFile& study);

/// Resolved study and gear as one text: /config of results.h5.
std::string config_text(const StudyFile& study);

/// "0.1.0"
std::string_view study_version();

/// "./seed_optimize-result" for studies/gallery/seed_optimize.toml, "…-reduced-result" for a reduced one.
std::filesystem::path default_result_folder(const StudyFile& study);

} // namespace strainwave
