#pragma once
// What the sub-commands of `study` share.

#include "app/exit_codes.hpp"
#include "strainwave/common/rows/journal_format.hpp"
#include "strainwave/common/threads/run_context.hpp"
#include "strainwave/studies/tables/run.hpp"

#include <functional>
#include <optional>
#include <string>

namespace strainwave::app {

struct StudyOptions {
  std::string file;
  std::string out;
  std::string shard; ///< "I/N"; empty: all
  bool reduced = false;
  bool json = false;
  bool no_cache = false;
  int threads = 0;
  std::optional<double> time_limit_s;
};

/// Runs `command`; a journal that is refused becomes a sentence and an exit code: 2 another plan, 74 damaged
/// or in use, 75 rows are missing, 3 shards contradict each other.
ExitCode with_journals(const std::function<ExitCode()>& command);

/// For whatever is run: threads counted once, signals heeded, warnings on stderr.
RunContext run_context(int threads, bool no_cache);

ExitCode run_search(const StudyOptions& options, const StudyFile& study, const ResultFolder& folder);
ExitCode run_rows_of(const StudyOptions& options, const StudyFile& study, const RowKind& kind,
                     const ResultFolder& folder);
ExitCode exit_code_of(RunEnd end);

/// The study of `options` and its folder, with the plan written. Throws UsageError where the folder is
/// another study's.
ResultFolder prepare_folder(const StudyOptions& options, const StudyFile& study);

} // namespace strainwave::app
