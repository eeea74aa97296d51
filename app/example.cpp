#include "app/commands.hpp"
#include "app/output.hpp"

namespace strainwave::app {

void add_example(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("example", "Print a complete gear file to start from (the seed gear)");
  command->footer(
      "Every key has a comment that says what it is and whether its value was published or assumed.\n"
      "Example:  strainwave example > mygear.toml");
  command->callback([&chosen] {
    chosen = [] {
      print(example_text);
      return ExitCode::done;
    };
  });
}

} // namespace strainwave::app
