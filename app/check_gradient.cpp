#include "app/commands.hpp"
#include "app/output.hpp"
#include "optimize/gradient_check.hpp"
#include "studies/optimisation.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>

namespace strainwave::app {

namespace {

struct CheckOptions {
  std::string file;
  bool reduced = false;
  bool json = false;
  bool no_cache = false;
};

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
                  const GradientCheck& check) {
  std::string text = fmt::format(
      "Derivatives at the start of {}, worst first. Relative errors of central differences at\n"
      "three steps, each half of the one before; a right derivative shows a factor of 4 (order 2).\n\n",
      study.file);
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
  const StudyFile study = load_study(options.file, options.reduced, study_vocabulary());
  const DesignSpace design = study_design(study);
  GearEvaluator model(study.gear, design, study_loads(study), {.disk_cache = !options.no_cache},
                      [](const std::string& sentence) { report(sentence); });
  const GradientCheck check = check_gradient(model, design, design.start());
  if (!check.ok) {
    report(options.file + ": " + check.message);
    return ExitCode::no_result;
  }
  print(options.json ? json(design, check).dump(2) + "\n" : table(study, design, model, check));
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
  command->footer(
      "At the start of the study: every output by every variable, and the worst tooth force, with the\n"
      "errors of differences at three steps. Exit code 3 when a derivative is wrong.\n"
      "Example:  strainwave check-gradient seed_optimize.toml");
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("STUDY", options->file, "A study file (TOML)")->required();
  command->add_flag("--reduced", options->reduced, "A small version of the study, as its [reduced] says");
  command->add_flag("--json", options->json, "Print one JSON object instead of the table");
  command->add_flag("--no-cache", options->no_cache, "Neither read nor write the cache of solved cups");
  command->callback([&chosen, options] { chosen = [options] { return run(*options); }; });
}

} // namespace strainwave::app
