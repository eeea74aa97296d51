#include "app/commands.hpp"
#include "app/output.hpp"
#include "app/study.hpp"
#include "strainwave/common/files/whole_file.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/studies/commands/reproduce.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace strainwave::app {

namespace {

struct EvalOptions {
  std::string folder, gear;
  std::uint64_t index = 0;
  int threads = 0;
  bool json = false, no_cache = false;
};

std::string row_json(const ReproducedRow& row) {
  nlohmann::ordered_json json{
      {"index", row.row}, {"rows", row.rows}, {"status", row.status}, {"message", row.message}};
  for (const auto& [key, values] : {std::pair{"inputs", &row.inputs}, {"outputs", &row.outputs}}) {
    json[key] = nlohmann::ordered_json::object();
    for (const NamedValue& v : *values)
      json[key][v.name] =
          std::isfinite(v.value) ? nlohmann::ordered_json(v.value) : nlohmann::ordered_json(nullptr);
  }
  json["same_as_recorded"] =
      row.same_bits ? nlohmann::ordered_json(*row.same_bits) : nlohmann::ordered_json(nullptr);
  if (!row.details.empty())
    json["details"] = nlohmann::ordered_json::parse(row.details);
  return json.dump(2) + "\n";
}

std::string row_table(const ReproducedRow& row) {
  std::string text = fmt::format("evaluation {} of {}: {}{}{}\n", row.row, row.rows, row.status,
                                 row.message.empty() ? "" : ", ", row.message);
  for (const auto& [heading, values] : {std::pair{"Inputs", &row.inputs}, {"Outputs", &row.outputs}}) {
    if (!values->empty())
      text += fmt::format("\n  {:<46} {:>8} {:>14}\n", heading, "unit", "value");
    for (const NamedValue& v : *values)
      text += fmt::format("  {:<46} {:>8} {:>14}\n", v.name, v.unit,
                          std::isfinite(v.value) ? fmt::format("{:.7g}", v.value) : "–");
  }
  if (row.same_bits)
    text += *row.same_bits ? "\nthe same bits as recorded\n"
                           : "\nOTHER numbers than recorded: another binary or another kind of processor\n";
  return text;
}

ExitCode eval(const EvalOptions& o) {
  const auto found = [&] {
    try {
      return reproduce_row(o.folder, o.index, run_context(o.threads, o.no_cache));
    } catch (const std::out_of_range& error) {
      throw UsageError(error.what());
    }
  }();
  if (!found) {
    report(found.failure().message);
    return ExitCode::no_result;
  }
  if (!o.gear.empty()) {
    if (!found->gear)
      throw UsageError("evaluation " + std::to_string(o.index) +
                       " is no gear that a file can hold: it has errors of single "
                       "teeth, or a number out of its range");
    write_whole_text(o.gear, write_gear(*found->gear));
  }
  print(o.json ? row_json(*found) : row_table(*found));
  return found->status == "ok" ? ExitCode::done : ExitCode::no_result;
}

} // namespace

void add_eval(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("eval", "Make one evaluation of a study again");
  command->footer(
      "The number of an evaluation is its row in results.h5. --gear writes it as a gear file for `analyze`.\n"
      "Exit code 3: it has no result; status and message say why.\n"
      "Example:  strainwave eval --from seed_overnight_sweep-result --index 17 --gear row17.toml");
  const auto o = std::make_shared<EvalOptions>();
  command->add_option("--from", o->folder, "The folder of a study")->required();
  command->add_option("--index", o->index, "Which evaluation, from 0")->required();
  command->add_option("--gear", o->gear, "Write its gear to this file");
  command->add_option("--threads", o->threads, "Threads (0: all cores)")->check(CLI::NonNegativeNumber);
  command->add_flag("--json", o->json, "Print one JSON object");
  command->add_flag("--no-cache", o->no_cache, "Neither read nor write the cache of solved cups");
  command->callback([&chosen, o] { chosen = [o] { return eval(*o); }; });
}

} // namespace strainwave::app
