// `study run` of kind "optimize" and "pareto".

#include "app/output.hpp"
#include "app/progress_line.hpp"
#include "app/stop_request.hpp"
#include "app/study.hpp"
#include "strainwave/studies/search/results_file.hpp"
#include "strainwave/studies/search/text.hpp"

#include <nlohmann/json.hpp>

namespace strainwave::app {

namespace {

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

} // namespace

ExitCode run_search(const StudyOptions& options, const StudyFile& study, const ResultFolder& folder) {
  const StopRequest stop(options.time_limit_s);
  const auto responses = gear_responses();
  const Response& objective = responses[*find_response(responses, study.part<SearchPart>().objective.output)];
  std::optional<SearchLine> line(std::in_place, std::string(objective.name), std::string(objective.unit));
  RunContext context = run_context(options.threads, options.no_cache);
  context.stop = stop; // the time limit, too
  const auto report_now = run_optimisation(
      study,
      {.context = context, .journal = folder.journal(), .progress = [&](const SearchProgress& progress) {
         line->show(progress, stop.seconds_left());
       }});
  line.reset();
  if (!report_now) {
    report(report_now.failure().message);
    return ExitCode::no_result;
  }
  if (!report_now->damage.empty())
    report(report_now->damage);
  if (!write_search_results(folder, *report_now))
    report("the folder keeps the finished result of an earlier run; this one was stopped early");
  const std::string name = folder.path().string();
  print(options.json ? optimisation_json(*report_now, name).dump(2) + "\n"
                     : optimisation_table(*report_now, name));
  if (report_now->verdict != Verdict::converged)
    report(std::string(verdict_name(report_now->verdict)) + ": " + report_now->message +
           (report_now->verdict == Verdict::stopped ? "; the same command goes on from here" : ""));
  if (!report_now->too_many_failed.empty() && report_now->verdict != Verdict::stopped) {
    report(report_now->too_many_failed);
    return ExitCode::no_result;
  }
  return exit_code(report_now->verdict);
}

} // namespace strainwave::app
