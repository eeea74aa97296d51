#include "strainwave/studies/report/report.hpp"
#include "app/commands.hpp"
#include "app/output.hpp"
#include "strainwave/studies/commands/kinds.hpp"

#include <memory>

namespace strainwave::app {

namespace {

ExitCode make_report(const std::string& folder) {
  const auto path = std::filesystem::path(folder);
  if (std::filesystem::exists(path / "plan.json") && !std::filesystem::exists(path / "results.h5"))
    throw UsageError((path / "results.h5").string() +
                     " is not there: run the study to its end, or `strainwave study merge` "
                     "its shards");
  const std::string note = write_report(path, study_kinds());
  if (!note.empty())
    report(note);
  print((path / "report.html").string() + "\n");
  return ExitCode::done;
}

} // namespace

void add_report(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("report", "Write a study's result as one self-contained HTML page");
  command->footer("DIR/report.html holds tables and figures and needs no network; DIR/figures has the data "
                  "and gnuplot scripts.\n"
                  "Example:  strainwave report seed_tolerance-result");
  const auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "The folder of a study")->required();
  command->callback([&chosen, folder] { chosen = [folder] { return make_report(*folder); }; });
}

} // namespace strainwave::app
