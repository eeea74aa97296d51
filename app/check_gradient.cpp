#include "app/commands.hpp"
#include "app/output.hpp"
#include "strainwave/optimize/problem/gradient_check.hpp"
#include "strainwave/studies/commands/kinds.hpp"
#include "strainwave/studies/file/study_gear.hpp"
#include "strainwave/studies/search/optimisation.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace strainwave::app {

namespace {

struct CheckOptions {
  std::string file;
  bool reduced = false;
  bool json = false;
  bool no_cache = false;
  bool at_start = false;
};

/// Where slopes are compared: the study's start, but numbers on a bound (one side only) or at 0 (where slope
/// and taper have a kink) moved into their range by odd shares of it, no two alike.
std::vector<double> smooth_point(const DesignSpace& design) {
  std::vector<double> x = design.start();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const DesignVariable& v = design.variables()[i];
    const double range = v.upper - v.lower, share = (0.061 + 0.0137 * static_cast<double>(i % 5)) * range;
    if (x[i] - v.lower < 0.01 * range || x[i] == 0.0)
      x[i] = std::min(x[i] + share, v.upper - 0.01 * range);
    else if (v.upper - x[i] < 0.01 * range)
      x[i] -= share;
  }
  return x;
}

const char* verdict_word(SlopeVerdict verdict) {
  switch (verdict) {
  case SlopeVerdict::wrong:
    return "WRONG";
  case SlopeVerdict::unknown:
    return "unknown";
  case SlopeVerdict::kink:
    return "kink";
  case SlopeVerdict::right:
    break;
  }
  return "right";
}

std::string table(const StudyFile& study, const DesignSpace& design, const GearEvaluator& model,
                  const GradientCheck& check, const std::vector<double>& x) {
  std::string text = fmt::format(
      "Derivatives of {}, worst first. Relative errors of central differences at\n"
      "three steps, each half of the one before; a right derivative shows a factor of 4 (order 2). At:\n",
      study.file);
  const std::vector<double> start = design.start();
  for (std::size_t i = 0; i < x.size(); ++i)
    text += fmt::format("  {} = {:.6g}{}\n", design.variables()[i].path.path(), x[i],
                        x[i] == start[i] ? "" : fmt::format(" (start {:.6g}: a bound or a kink)", start[i]));
  text += "\n";
  text += fmt::format("{:<8} {:<32} {:<42} {:>13} {:>13}  {:>9} {:>9} {:>9} {:>6}\n", "", "response",
                      "variable", "derivative", "difference", "h", "h/2", "h/4", "order");
  for (const SlopeCheck& s : check.slopes) {
    const double order = std::log2(s.error[1] / s.error[2]);
    text += fmt::format("{:<8} {:<32} {:<42} {:>13.6g} {:>13.6g}  {:>9.2g} {:>9.2g} {:>9.2g} {:>6}\n",
                        verdict_word(s.verdict), s.response, design.variables()[s.variable].path.path(),
                        s.exact, s.difference, s.error[0], s.error[1], s.error[2],
                        std::isfinite(order) && s.error[2] > 0.0 ? fmt::format("{:.1f}", order) : "–");
    if (s.verdict == SlopeVerdict::kink)
      text += fmt::format("{:<8} one-sided slopes {:.6g} and {:.6g}\n", "", s.left, s.right);
  }
  for (std::size_t i = 0; i < design.size(); ++i)
    if (!model.exact(i))
      text += fmt::format(
          "\n{} acts through the finite elements: its derivatives are differences of whole evaluations.",
          design.variables()[i].path.path());
  return text + (check.wrong == 0 ? "\nno wrong derivative\n" : fmt::format("\n{} wrong\n", check.wrong));
}

nlohmann::ordered_json json(const DesignSpace& design, const GradientCheck& check) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const SlopeCheck& s : check.slopes)
    rows.push_back({{"verdict", verdict_word(s.verdict)},
                    {"response", s.response},
                    {"variable", design.variables()[s.variable].path.path()},
                    {"value", s.value},
                    {"derivative", s.exact},
                    {"difference", s.difference},
                    {"steps", s.step},
                    {"relative_errors", s.error},
                    {"left", s.left},
                    {"right", s.right}});
  return {{"wrong", check.wrong}, {"slopes", rows}};
}

ExitCode run(const CheckOptions& options) {
  const StudyFile study = load_study(options.file, study_kinds(), options.reduced);
  if (!study.find_part<SearchPart>())
    throw UsageError(options.file + " is no search: there are no design variables to check slopes of");
  const DesignSpace design = study_design(study);
  const std::vector<double> x = options.at_start ? design.start() : smooth_point(design);
  GearEvaluator model(study.gear, design, study_loads(study), {.disk_cache = !options.no_cache},
                      [](const std::string& sentence) { report(sentence); });
  const GradientCheck check = check_gradient(model, design, x);
  if (!check.ok) {
    report(options.file + ": " + check.message);
    return ExitCode::no_result;
  }
  print(options.json ? json(design, check).dump(2) + "\n" : table(study, design, model, check, x));
  if (check.wrong == 0)
    return ExitCode::done;
  const SlopeCheck& worst = check.slopes.front();
  report(fmt::format(
      "{}: {} wrong derivatives, the worst that of {} with respect to {}: {:.6g} instead of {:.6g}",
      options.file, check.wrong, worst.response, design.variables()[worst.variable].path.path(), worst.exact,
      worst.difference));
  return ExitCode::no_result;
}

} // namespace

void add_check_gradient(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("check-gradient", "Compare the derivatives of a study's outputs with differences");
  command->footer("At the start of the study, a little inside its bounds: every output by every variable, "
                  "and the worst tooth force, with the\n"
                  "errors of differences at three steps. Exit code 3 when a derivative is wrong.\n"
                  "Example:  strainwave check-gradient seed_optimize.toml");
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("STUDY", options->file, "A study file (TOML)")->required();
  command->add_flag("--reduced", options->reduced, "A small version of the study, as its [reduced] says");
  command->add_flag(
      "--at-start", options->at_start,
      "Exactly at the start, also on bounds and kinks: there a derivative is one of the one-sided ones");
  command->add_flag("--json", options->json, "Print one JSON object instead of the table");
  command->add_flag("--no-cache", options->no_cache, "Neither read nor write the cache of solved cups");
  command->callback([&chosen, options] { chosen = [options] { return run(*options); }; });
}

} // namespace strainwave::app
