#pragma once
// The sub-commands. Each add_… declares one sub-command with its options; when the user names it, it puts
// what is to be done into `chosen`, and main runs that after the whole command line has been read.

#include "app/exit_codes.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <string_view>

namespace strainwave::app {

using Command = std::function<ExitCode()>;

void add_example(CLI::App& app, Command& chosen);
void add_schema(CLI::App& app, Command& chosen);
void add_analyze(CLI::App& app, Command& chosen);
void add_check(CLI::App& app, Command& chosen);
void add_export(CLI::App& app, Command& chosen);
void add_study(CLI::App& app, Command& chosen);
void add_check_gradient(CLI::App& app, Command& chosen);
void add_report(CLI::App& app, Command& chosen);
void add_eval(CLI::App& app, Command& chosen);

/// Below `study`.
void add_study_plan(CLI::App& study, Command& chosen);
void add_study_status(CLI::App& study, Command& chosen);
void add_study_merge(CLI::App& study, Command& chosen);
void add_study_compare(CLI::App& study, Command& chosen);

/// The text of studies/gallery/seed.toml.
extern const std::string_view example_text;

} // namespace strainwave::app
