#include "app/wrong_use.hpp"

#include "strainwave/common/core/nearest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <regex>
#include <sstream>
#include <string_view>
#include <vector>

namespace strainwave::app {

namespace {

/// The sub-command that was being read when the error came; the program itself if none was.
const CLI::App& innermost(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : innermost(*chosen.back());
}

/// "strainwave study run"
std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent ? full_name(*parent) + " " + command.get_name() : command.get_name();
}

std::vector<std::string> legal_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames())
      names.push_back("--" + name);
    for (const std::string& name : option->get_snames())
      names.push_back("-" + name);
  }
  return names;
}

std::vector<std::string> legal_commands(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  return names;
}

std::string unknown(std::string_view what, const std::string& word, const std::vector<std::string>& legal) {
  std::vector<std::string_view> views(legal.begin(), legal.end());
  views.insert(views.end(), {"--help", "--version"}); // strainwave help
  const Nearest nearest = nearest_name(word, views);
  if (nearest.name.empty())
    return fmt::format("{} is not expected here", word);
  if (nearest.close)
    return fmt::format("there is no {} {}; did you mean {}?", what, word, nearest.name);
  std::string list;
  for (const std::string& name : legal)
    list += (list.empty() ? "" : ", ") + name;
  return fmt::format("there is no {} {}; the nearest legal one is {} (of {})", what, word, nearest.name,
                     list);
}

/// CLI11's own words for a wrong value, said again in ours.
std::string value_sentence(const std::string& words) {
  std::smatch found;
  const auto is = [&](const char* pattern) { return std::regex_match(words, found, std::regex(pattern)); };
  if (is("Could not convert: (.*) = (.*)"))
    return fmt::format("{}: expected a number, got {}", found[1].str(), found[2].str());
  if (is("(.*): .* required .* missing"))
    return fmt::format("{}: the value is missing", found[1].str());
  if (is("(.*): Value (.*) not in range (-?\\d+)\\.\\d* to (-?\\d+)\\.\\d*")) {
    const std::string upper = found[4].length() > 18 ? "" : " and at most " + found[4].str();
    return fmt::format("{}: expected a number of at least {}{}, got {}", found[1].str(), found[3].str(),
                       upper, found[2].str());
  }
  if (is("(.*): (.*) not in \\{(.*)\\}")) {
    std::vector<std::string> legal;
    std::stringstream list(found[3].str());
    for (std::string one; std::getline(list, one, ',');)
      legal.push_back(one);
    const std::vector<std::string_view> views(legal.begin(), legal.end());
    const std::string wrong = found[2].str();
    const Nearest nearest = nearest_name(wrong, views);
    return fmt::format("{}: expected {}, got {}{}", found[1].str(), fmt::join(legal, ", "), wrong,
                       nearest.close ? fmt::format("; did you mean {}?", nearest.name) : "");
  }
  return words;
}

std::string sentence_without_hint(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = innermost(app);
  const std::vector<std::string> commands = legal_commands(command);
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
    const std::vector<std::string> extras = app.remaining(true);
    for (const std::string& extra : extras) {
      if (extra.size() > 1 && extra[0] == '-')
        return unknown("option", extra.substr(0, extra.find('=')), legal_options(command));
      if (!commands.empty())
        return unknown("command", extra, commands);
      return fmt::format("{} is one argument too many", extra);
    }
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) && !commands.empty()) {
    std::string list;
    for (const std::string& name : commands)
      list += (list.empty() ? "" : ", ") + name;
    return fmt::format("a command is missing; expected one of {}", list);
  }
  return value_sentence(error.what());
}

} // namespace

std::string wrong_use_sentence(const CLI::App& app, const CLI::ParseError& error) {
  return fmt::format("{}\n`{} --help` explains the use", sentence_without_hint(app, error),
                     full_name(innermost(app)));
}

} // namespace strainwave::app
