#include "app/commands.hpp"
#include "app/output.hpp"
#include "app/result_table.hpp"
#include "strainwave/common/files/whole_file.hpp"
#include "strainwave/model/export/figures.hpp"
#include "strainwave/model/export/flank_figures.hpp"
#include "strainwave/model/export/result_file.hpp"
#include "strainwave/model/export/result_json.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/model/results/load_path.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace strainwave::app {

namespace {

struct AnalyzeOptions {
  std::string file;
  std::vector<double> torque_nm;
  std::vector<double> rotation_rad;
  std::string only;
  bool json = false;
  bool no_cache = false;
  bool path = false;
  std::string out;
  std::string plots;
  int threads = 0;
};

/// Every figure that the result has numbers for; what gnuplot could not draw is a note, not a failure.
void draw_figures(const ForwardResult& result, const LoadPath* path, Gear gear, Want want,
                  ForwardModel& model, const std::string& folder) {
  std::vector<Figure> figures = backlash_figures(result);
  if (want != Want::backlash && result.status == Status::ok) {
    if (const auto states = model.contact_states(gear))
      figures.push_back(assembled_shape_figure(states->states.front()));
  }
  for (Figure& figure : load_figures(result))
    figures.push_back(std::move(figure));
  for (Figure& figure : flank_figures(result, gear))
    figures.push_back(std::move(figure));
  if (const std::vector<double> rotations = sweep_rotations_rad(result); !rotations.empty()) {
    gear.load.torque_nm.clear();
    gear.load.rotation_rad = rotations;
    gear.load.phases = 1;
    figures.push_back(torque_rotation_figure(result, model.analyze(gear), path));
  }
  if (figures.empty())
    return;
  if (const Drawn drawn = draw(figures, folder); !drawn.complete)
    report(drawn.note);
}

/// Places of results are tried before anything is computed: minutes later would be too late.
void try_places(const AnalyzeOptions& options) {
  if (!options.out.empty())
    try_to_write(options.out);
  if (options.plots.empty())
    return;
  std::filesystem::create_directories(options.plots);
  try_to_write(std::filesystem::path(options.plots) / "initial-backlash.dat");
}

ExitCode analyze(const AnalyzeOptions& options) {
  if (options.path && !options.only.empty() && options.only != "load")
    throw UsageError(fmt::format("--path needs the loads; --only {} stops before them", options.only));
  const GearDocument document = load_gear(options.file);
  for (const std::string& warning : document.warnings)
    report(warning);
  Gear gear = document.gear;
  if (!options.torque_nm.empty() || !options.rotation_rad.empty()) {
    gear.load.torque_nm.clear();
    gear.load.rotation_rad.clear();
    if (!options.torque_nm.empty())
      set_value(gear, "load.torque_nm", options.torque_nm);
    if (!options.rotation_rad.empty())
      set_value(gear, "load.rotation_rad", options.rotation_rad);
  }
  const Want want = options.only == "backlash"     ? Want::backlash
                    : options.only == "compliance" ? Want::compliance
                                                   : Want::load;
  refuse_to_replace(options.out, {options.file, gear.wave_generator.table_file});
  try_places(options);
  ForwardModel model({.disk_cache = !options.no_cache, .threads = options.threads});
  const ForwardResult result = model.analyze(gear, want);
  for (const std::string& warning : result.warnings)
    report(warning);
  std::optional<LoadPath> path;
  std::string no_path;
  if (options.path && result.status == Status::ok) {
    const auto traced = model.load_path(gear);
    if (traced)
      path = *traced;
    else
      no_path = traced.failure().message;
  }
  const LoadPath* const found = path ? &*path : nullptr;
  print(options.json ? result_json_text(result, found) + "\n"
                     : result_table(result) + (found ? "\n" + path_table(*found) : ""));
  if (!options.out.empty())
    write_result_file(result, write_gear(gear), options.out, found);
  if (!options.plots.empty())
    draw_figures(result, found, gear, want, model, options.plots);
  if (!no_path.empty()) {
    report(options.file + ": no load path: " + no_path);
    return ExitCode::no_result;
  }
  if (result.status == Status::ok)
    return ExitCode::done;
  report(options.file + ": " + result.message);
  return ExitCode::no_result;
}

} // namespace

void add_analyze(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "analyze", "From a gear file to backlash, compliance, meshing forces and torsional stiffness");
  command->footer("Loads of the command line replace those of the file's [load]. Torques count both lobes.\n"
                  "The finite elements of a cup are solved once and kept in the cache directory\n"
                  "($STRAINWAVE_CACHE, else $XDG_CACHE_HOME/strainwave, else ~/.cache/strainwave).\n"
                  "Examples:  strainwave analyze mygear.toml\n"
                  "           strainwave analyze mygear.toml --torque-nm 3.5 7 --json\n"
                  "           strainwave analyze mygear.toml --path --plots figures\n"
                  "           strainwave analyze mygear.toml --only backlash");
  const auto options = std::make_shared<AnalyzeOptions>();
  command->add_option("FILE", options->file, "A gear file (TOML)")->required();
  command->add_option("--torque-nm", options->torque_nm, "Output torques, N·m");
  command->add_option("--rotation-rad", options->rotation_rad, "Rotations of the circular spline, rad");
  command->add_option("--only", options->only, "Stop after this stage: backlash, compliance or load")
      ->check(CLI::IsMember({"backlash", "compliance", "load"}));
  command->add_flag("--json", options->json, "Print one JSON object instead of the table");
  command->add_flag("--path", options->path,
                    "Also trace the torque–rotation curve from event to event: when which tooth begins or "
                    "ceases to carry");
  command->add_option("-o,--out", options->out, "Also write the result to this HDF5 file");
  command->add_option("--plots", options->plots,
                      "Also draw figures into this folder (SVG by gnuplot, with their data)");
  command->add_option("--threads", options->threads, "Threads for the finite elements (0: all cores)")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--no-cache", options->no_cache, "Neither read nor write the cache of solved cups");
  command->callback([&chosen, options] { chosen = [options] { return analyze(*options); }; });
}

} // namespace strainwave::app
