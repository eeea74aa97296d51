#include "app/commands.hpp"
#include "app/output.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/model/gear_file/toml_source.hpp"
#include "strainwave/studies/commands/kinds.hpp"

#include <memory>

namespace strainwave::app {

namespace {

ExitCode check(const std::string& file) {
  const std::string text = read_text_file(file, "gear file");
  Gear gear;
  if (is_study_text(text, study_kinds())) {
    const StudyFile study = parse_study(text, file, study_kinds());
    print(write_study(study));
    gear = study.gear;
  } else {
    const GearDocument document = parse_gear(text, file);
    for (const std::string& warning : document.warnings)
      report(warning);
    gear = document.gear;
    print(write_gear(gear));
  }
  // Teeth, wave generator and backlash are computed: a gear without a result says so here as it does in
  // `analyze`.
  const ForwardResult result = ForwardModel({.disk_cache = false}).analyze(gear, Want::backlash);
  if (result.status != Status::ok) {
    report(file + ": " + result.message);
    return ExitCode::no_result;
  }
  if (const auto unavailable = find_unavailable(gear)) {
    report(file + ": " + unavailable->message);
    return ExitCode::no_result;
  }
  return ExitCode::done;
}

} // namespace

void add_check(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("check", "Validate a gear or study file and print it with every default filled in");
  command->footer("All faults of the file are listed with line and column; the exit code is then 2.\n"
                  "Exit code 3: the file is sound, but its numbers make no gear.\n"
                  "Example:  strainwave check mygear.toml");
  const auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "A gear file or a study file (TOML)")->required();
  command->callback([&chosen, file] { chosen = [file] { return check(*file); }; });
}

} // namespace strainwave::app
