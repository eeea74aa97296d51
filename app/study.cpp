#include "app/commands.hpp"
#include "app/output.hpp"
#include "app/progress_line.hpp"
#include "app/stop_request.hpp"
#include "studies/optimisation_text.hpp"
#include "studies/result_folder.hpp"

#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace strainwave::app {

namespace {

struct StudyOptions {
  std::string file;
  std::string out;
  bool reduced = false;
  bool json = false;
  bool no_cache = false;
  int threads = 0;
  std::optional<double> time_limit_s;
};

ExitCode exit_code(Verdict verdict) {
  switch (verdict) {
  case Verdict::stopped:
    return ExitCode::stopped;
  case Verdict::infeasible:
    return ExitCode::no_result;
  default:
    return ExitCode::done;
  }
}

ExitCode run(const StudyOptions& options) {
  const StopRequest stop(options.time_limit_s);
  catch_stop_signals();
  const StudyFile study = load_study(options.file, options.reduced, study_vocabulary());
  if (study.kind != StudyKind::optimize && study.kind != StudyKind::pareto)
    throw UsageError(study.file + ": this kind of study cannot be run by this version");
  const ResultFolder folder(options.out.empty() ? default_result_folder(study)
                                                : std::filesystem::path(options.out));
  if (const std::string reason = folder.occupied(study); !reason.empty())
    throw UsageError(reason);
  folder.write_plan(study);

  const auto responses = gear_responses();
  const Response& objective = responses[*find_response(responses, study.objective.output)];
  std::optional<ProgressLine> line(std::in_place, std::string(objective.name), std::string(objective.unit));
  const auto report_now = run_optimisation(
      study, {.threads = options.threads,
              .disk_cache = !options.no_cache,
              .stop = stop,
              .progress = [&](const SearchProgress& progress) { line->show(progress, stop.seconds_left()); },
              .warn = [](const std::string& sentence) { report(sentence); }});
  line.reset();
  if (!report_now) {
    report(report_now.failure().message);
    return ExitCode::no_result;
  }
  if (!folder.write_results(*report_now))
    report("the folder keeps the finished result of an earlier run; this one was stopped early");
  const std::string name = folder.path().string();
  print(options.json ? optimisation_json(*report_now, name).dump(2) + "\n"
                     : optimisation_table(*report_now, name));
  if (report_now->verdict != Verdict::converged)
    report(std::string(verdict_name(report_now->verdict)) + ": " + report_now->message);
  return exit_code(report_now->verdict);
}

} // namespace

void add_study(CLI::App& app, Command& chosen) {
  CLI::App* study = app.add_subcommand("study", "Many gears at once: optimisation");
  study->require_subcommand(0, 1);
  CLI::App* command = study->add_subcommand("run", "Run a study file; the result beside the unmodified gear");
  command->footer(
      "The verdict is the program's own: the optimum is searched again from close by and evaluated afresh.\n"
      "Exit code 3: no feasible design (the nearest one is shown); 75: stopped early.\n"
      "Example:  strainwave study run studies/gallery/seed_optimize.toml");
  const auto options = std::make_shared<StudyOptions>();
  command->add_option("STUDY", options->file, "A study file (TOML)")->required();
  command->add_option("--out", options->out, "Folder for the results (default: ./NAME-result)");
  command->add_flag("--reduced", options->reduced, "A small version of the study, as its [reduced] says");
  command->add_option("--threads", options->threads, "Threads (0: all cores)")->check(CLI::NonNegativeNumber);
  command->add_option("--time-limit", options->time_limit_s, "Stop after so many seconds")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--json", options->json, "Print one JSON object instead of the table");
  command->add_flag("--no-cache", options->no_cache, "Neither read nor write the cache of solved cups");
  command->callback([&chosen, options] { chosen = [options] { return run(*options); }; });
}

} // namespace strainwave::app
