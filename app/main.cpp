// strainwave: backlash, meshing forces and stiffness of strain wave gears, from the command line.

#include "app/commands.hpp"
#include "app/output.hpp"
#include "app/wrong_use.hpp"

#include "strainwave/version.hpp"

namespace strainwave::app {
namespace {

ExitCode read_and_run(int argc, char** argv) {
  CLI::App app("Backlash, meshing forces and torsional stiffness of strain wave gears (harmonic drives).",
               "strainwave");
  app.set_version_flag("--version", std::string("strainwave ") + library_version,
                       "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.require_subcommand(0, 1); // none at all gets our own sentence
  app.get_formatter()->column_width(34);
  app.footer("Start with `strainwave example > mygear.toml`, change what you know about your gear, and\n"
             "`strainwave check mygear.toml`. `strainwave COMMAND --help` explains one command.\n"
             "Results go to stdout, everything else to stderr.\n"
             "Exit codes: 0 done; 2 wrong use or wrong file; 3 the gear has no result; 70 a bug; 74 disk, "
             "memory or\n"
             "permissions; 75 stopped early, run again.");
  Command chosen;
  add_analyze(app, chosen);
  add_export(app, chosen);
  add_example(app, chosen);
  add_check(app, chosen);
  add_schema(app, chosen);
  add_study(app, chosen);
  add_check_gradient(app, chosen);
  add_eval(app, chosen);
  add_report(app, chosen);
  try {
    app.parse(argc, argv);
    if (!chosen)
      throw CLI::RequiredError("a command");
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + "\n");
    return ExitCode::done;
  } catch (const CLI::Success&) {                                  // --help
    if (app.get_subcommands().empty() && !app.remaining().empty()) // strainwave chek --help
      throw UsageError(wrong_use_sentence(app, CLI::ExtrasError(app.remaining())));
    print(app.help());
    return ExitCode::done;
  } catch (const CLI::ParseError& error) {
    throw UsageError(wrong_use_sentence(app, error));
  }
  return chosen();
}

} // namespace
} // namespace strainwave::app

int main(int argc, char** argv) {
  using namespace strainwave::app;
  install_process_habits();
  return static_cast<int>(run_guarded([&] { return read_and_run(argc, argv); }));
}
