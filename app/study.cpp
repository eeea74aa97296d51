#include "app/study.hpp"

#include "app/commands.hpp"
#include "app/output.hpp"
#include "app/stop_request.hpp"
#include "strainwave/common/threads/parallel.hpp"
#include "strainwave/studies/commands/kinds.hpp"
#include "strainwave/studies/search/optimisation.hpp"

#include <memory>

namespace strainwave::app {

namespace {

ExitCode run(const StudyOptions& options) {
  const StopRequest stop(options.time_limit_s);
  catch_stop_signals();
  const StopGuard guard(stop);
  const StudyFile study = load_study(options.file, study_kinds(), options.reduced);
  const RowKind* rows = row_kind(study);
  if (!rows && !options.shard.empty())
    throw UsageError("--shard is for studies whose points are known in advance; a search chooses every point "
                     "by the ones before it");
  const ResultFolder folder = prepare_folder(options, study);
  return with_journals(
      [&] { return rows ? run_rows_of(options, study, *rows, folder) : run_search(options, study, folder); });
}

void add_run(CLI::App& study, Command& chosen) {
  CLI::App* command = study.add_subcommand("run", "Run a study file, or go on with it where it was stopped");
  command->footer(
      "Every evaluation is kept in the folder; the same command again goes on where it was stopped.\n"
      "Exit code 3: no feasible design, or too many failed evaluations; 75: stopped early, run again.\n"
      "Example:  strainwave study run studies/gallery/seed_optimize.toml");
  const auto options = std::make_shared<StudyOptions>();
  command->add_option("STUDY", options->file, "A study file (TOML)")->required();
  command->add_option("--out", options->out, "Folder for the results (default: ./NAME-result)");
  command->add_flag("--reduced", options->reduced, "A small version of the study, as its [reduced] says");
  command->add_option("--threads", options->threads, "Threads (0: all cores)")->check(CLI::NonNegativeNumber);
  command->add_option("--shard", options->shard,
                      "I/N: only part I (from 0) of N; join them with `study merge`");
  command->add_option("--time-limit", options->time_limit_s, "Stop after so many seconds")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--json", options->json, "Print one JSON object instead of the table");
  command->add_flag("--no-cache", options->no_cache, "Neither read nor write the cache of solved cups");
  command->callback([&chosen, options] { chosen = [options] { return run(*options); }; });
}

} // namespace

RunContext run_context(int threads, bool no_cache) {
  return {.threads = usable_threads(threads),
          .disk_cache = !no_cache,
          .stop = stop_signalled,
          .warn = [](const std::string& sentence) { report(sentence); }};
}

ExitCode with_journals(const std::function<ExitCode()>& command) {
  try {
    return command();
  } catch (const JournalError& error) {
    report(error.what());
    switch (error.fault) {
    case JournalFault::other_plan:
    case JournalFault::other_model:
    case JournalFault::other_shape:
    case JournalFault::not_a_journal:
      return ExitCode::wrong_input;
    case JournalFault::contradiction:
      return ExitCode::no_result;
    case JournalFault::gaps:
      return ExitCode::stopped;
    case JournalFault::locked:
    case JournalFault::damaged:
      break;
    }
    return ExitCode::environment;
  }
}

ResultFolder prepare_folder(const StudyOptions& options, const StudyFile& study) {
  ResultFolder folder(options.out.empty() ? default_result_folder(study)
                                          : std::filesystem::path(options.out));
  if (const std::string reason = folder.occupied(study); !reason.empty())
    throw UsageError(reason);
  folder.write_plan(study);
  return folder;
}

void add_study(CLI::App& app, Command& chosen) {
  CLI::App* study = app.add_subcommand("study", "Many gears at once: optimisation, sweeps, tolerances");
  study->require_subcommand(0, 1);
  add_run(*study, chosen);
  add_study_plan(*study, chosen);
  add_study_status(*study, chosen);
  add_study_merge(*study, chosen);
  add_study_compare(*study, chosen);
}

} // namespace strainwave::app
