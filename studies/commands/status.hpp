#pragma once
// What of a study is done: read from its folder alone, also while it runs.

#include "strainwave/studies/results/result_folder.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace strainwave {

struct JournalStatus {
  std::string file; ///< name within DIR/shards
  std::uint32_t shard = 0, shards = 1;
  std::uint64_t rows = 0; ///< of this shard; 0: a search, which knows no end
  std::uint64_t done = 0, failed = 0;
  bool running = false; ///< a process writes it right now
  std::string note;     ///< torn tail, not this study's, …
};

struct StudyStatus {
  StudyFile study;
  std::vector<JournalStatus> journals;
  std::uint64_t rows = 0; ///< of the study; 0: not known
  std::uint64_t done = 0, failed = 0;
  std::string missing;      ///< which shards to run again; empty: nothing is missing
  bool has_results = false; ///< results.h5 is there
  std::string verdict;      ///< of a search that has ended
};

/// Throws FileError for a folder without a plan.
StudyStatus study_status(const std::filesystem::path& folder);

} // namespace strainwave
