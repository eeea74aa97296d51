#include "app/commands.hpp"
#include "app/output.hpp"
#include "model/forward/forward.hpp"
#include "model/gear_file/gear_file.hpp"

#include <memory>

namespace strainwave::app {

void add_check(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("check", "Validate a gear file and print it with every default filled in");
  command->footer("All faults of the file are listed with line and column; the exit code is then 2.\n"
                  "Exit code 3: the file is sound, but its numbers make no gear.\n"
                  "Example:  strainwave check mygear.toml");
  const auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "A gear file (TOML)")->required();
  command->callback([&chosen, file] {
    chosen = [file] {
      const Gear gear = load_gear(*file).gear;
      print(write_gear(gear));
      // Teeth, wave generator and backlash are computed: a gear without a result says so here as it does in `analyze`.
      const ForwardResult result = ForwardModel({.disk_cache = false}).analyze(gear, Want::backlash);
      if (result.status == Status::ok) return ExitCode::done;
      report(result.message);
      return ExitCode::no_result;
    };
  });
}

} // namespace strainwave::app
