#include "app/commands.hpp"
#include "app/output.hpp"
#include "model/gear_file/gear_file.hpp"

#include <memory>

namespace strainwave::app {

void add_check(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("check", "Validate a gear file and print it with every default filled in");
  command->footer("All faults of the file are listed with line and column; the exit code is then 2.\n"
                  "Example:  strainwave check mygear.toml");
  const auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "A gear file (TOML)")->required();
  command->callback([&chosen, file] {
    chosen = [file] {
      print(write_gear(load_gear(*file).gear));
      return ExitCode::done;
    };
  });
}

} // namespace strainwave::app
