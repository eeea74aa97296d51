#pragma once
// One sentence for a command line that was not understood, with the nearest legal command or option.

#include <CLI/CLI.hpp>

#include <string>

namespace strainwave::app {

/// `app` after its parse() has thrown `error`.
std::string wrong_use_sentence(const CLI::App& app, const CLI::ParseError& error);

} // namespace strainwave::app
