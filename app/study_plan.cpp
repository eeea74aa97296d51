// `study plan`: what a study will cost, before a night is spent on it.

#include "app/commands.hpp"
#include "app/output.hpp"
#include "app/study.hpp"
#include "strainwave/studies/commands/kinds.hpp"
#include "strainwave/studies/commands/plan.hpp"
#include "strainwave/studies/search/optimisation.hpp"
#include "strainwave/studies/tables/row_kind.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>

namespace strainwave::app {

namespace {

std::string size_text(double bytes) {
  if (bytes < 1e6)
    return fmt::format("{:.0f} kB", std::max(1.0, bytes / 1e3));
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

ExitCode plan(const StudyOptions& options) {
  const StudyFile study = load_study(options.file, study_kinds(), options.reduced);
  const ResultFolder folder = prepare_folder(options, study);
  const auto estimate = pilot(study, run_context(options.threads, true));
  if (!estimate) {
    report(estimate.failure().message);
    return ExitCode::no_result;
  }
  const PilotEstimate& e = *estimate;
  const double disk = e.journal_bytes + e.results_bytes;
  const double free = static_cast<double>(std::filesystem::space(folder.path()).available);
  if (options.json) {
    nlohmann::ordered_json json{{"kind", study.kind->name()},
                                {"evaluations", e.evaluations},
                                {"cups", e.cups},
                                {"threads", e.threads},
                                {"seconds", e.seconds},
                                {"seconds_each", e.each_s},
                                {"seconds_first", e.first_s},
                                {"disk_bytes", disk},
                                {"disk_free_bytes", free},
                                {"memory_bytes", e.memory_bytes},
                                {"pilot", {{"evaluations", e.tried}, {"failed", e.failures.size()}}},
                                {"folder", folder.path().string()}};
    print(json.dump(2) + "\n");
  } else {
    std::string text = fmt::format("{}: {} of \"{}\"\n", std::filesystem::path(study.file).stem().string(),
                                   study.kind->name(), study.gear.name);
    text += fmt::format("  evaluations  {}{}{}\n", row_kind(study) ? "" : "at most ", e.evaluations,
                        e.cups > 1 ? fmt::format(" on {} cups, each solved once", e.cups) : "");
    text += fmt::format("  time         about {} with {} thread{} ({:.3g} ms each{})\n",
                        duration_text(e.seconds), e.threads, e.threads == 1 ? "" : "s", 1e3 * e.each_s,
                        e.cups > 1 ? fmt::format(", {:.3g} s where a cup is solved", e.first_s) : "");
    text += fmt::format("  disk         {} of {} that are free\n", size_text(disk), size_text(free));
    text += fmt::format("  memory       {}\n", size_text(e.memory_bytes));
    text += fmt::format("  from {} evaluations of a pilot, {} of which failed\n", e.tried, e.failures.size());
    text += fmt::format("  run it       strainwave study run {} --out {}{}\n", options.file,
                        folder.path().string(), options.reduced ? " --reduced" : "");
    print(text);
  }
  if (!e.failures.empty())
    report(fmt::format("an evaluation of the pilot failed: {}", e.failures.front()));
  if (disk > free)
    report("the disk is too full for this study");
  return ExitCode::done;
}

} // namespace

void add_study_plan(CLI::App& study, Command& chosen) {
  CLI::App* command =
      study.add_subcommand("plan", "Freeze the plan of a study and estimate time, disk and memory");
  command->footer("Some evaluations are tried (a few seconds); none of them is kept.\n"
                  "Example:  strainwave study plan studies/gallery/seed_overnight_sweep.toml --out night");
  const auto options = std::make_shared<StudyOptions>();
  command->add_option("STUDY", options->file, "A study file (TOML)")->required();
  command->add_option("--out", options->out, "Folder for the results (default: ./NAME-result)");
  command->add_flag("--reduced", options->reduced, "A small version of the study, as its [reduced] says");
  command->add_option("--threads", options->threads, "Threads (0: all cores)")->check(CLI::NonNegativeNumber);
  command->add_flag("--json", options->json, "Print one JSON object");
  command->callback([&chosen, options] { chosen = [options] { return plan(*options); }; });
}

} // namespace strainwave::app
