#include "app/commands.hpp"
#include "app/output.hpp"
#include "strainwave/common/files/whole_file.hpp"
#include "strainwave/model/export/contact_file.hpp"
#include "strainwave/model/export/cup_deck.hpp"
#include "strainwave/model/export/cup_fields.hpp"
#include "strainwave/model/export/profile_csv.hpp"
#include "strainwave/model/export/profile_dxf.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/model/tooth/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace strainwave::app {

namespace {

struct ExportOptions {
  std::string file;
  std::string calculix, vtkhdf, profile, contact;
  UnitToothLoad load;
  std::string direction = "circumferential";
  bool contact_forces = false;
  std::vector<double> torque_nm;
  ProfileOptions outlines;
  bool no_cache = false;
  std::vector<std::string> given; ///< names of the options on the command line
};

ExitCode no_result(const Failure& failure) {
  report(failure.message);
  return ExitCode::no_result;
}

Outcome<ContactStates> contact_states(const Gear& gear, const ExportOptions& options) {
  ForwardModel model({.disk_cache = !options.no_cache});
  auto states = model.contact_states(gear);
  if (states)
    for (const std::string& warning : states->warnings)
      report(warning);
  return states;
}

ExitCode write_deck(const Gear& gear, const ExportOptions& options) {
  const auto deck = [&]() -> Outcome<std::string> {
    if (!options.contact_forces)
      return calculix_deck(gear, options.load);
    const auto states = contact_states(gear, options);
    if (!states)
      return states.failure();
    return calculix_deck(gear, *states);
  }();
  if (!deck)
    return no_result(deck.failure());
  write_whole_text(options.calculix, *deck);
  return ExitCode::done;
}

ExitCode write_fields(const Gear& gear, const ExportOptions& options) {
  const auto states = contact_states(gear, options);
  if (!states)
    return no_result(states.failure());
  const auto fields = cup_fields(*states);
  if (!fields)
    return no_result(fields.failure());
  write_vtkhdf(field_grid(*fields), write_gear(gear), options.vtkhdf);
  report(fmt::format(
      "{} nodes; fields agree with the contact analysis to {:.1e} mm at the wall, equilibrium {:.1e}",
      fields->mesh.ring_nodes(), fields->contact_difference_mm, fields->field.residual));
  return ExitCode::done;
}

ExitCode write_profile(const Gear& gear, const ExportOptions& options) {
  const auto outlines = profile_outlines(gear, options.outlines);
  if (!outlines)
    return no_result(outlines.failure());
  write_whole_text(options.profile,
                   options.profile.ends_with(".dxf") ? profile_dxf(*outlines) : profile_csv(*outlines));
  return ExitCode::done;
}

ExitCode write_contact(const Gear& gear, const ExportOptions& options) {
  ForwardModel model({.disk_cache = !options.no_cache});
  const auto phases = model.phase_problems(gear);
  if (!phases)
    return no_result(phases.failure());
  write_contact_file(*phases, write_gear(gear), options.contact);
  return ExitCode::done;
}

/// Options that nothing asked for would read: a misunderstanding, not to be passed over.
void refuse_idle_options(const ExportOptions& options) {
  const bool unit_load = !options.calculix.empty() && !options.contact_forces;
  const bool loaded = !options.vtkhdf.empty() || (!options.calculix.empty() && options.contact_forces);
  struct Rule {
    const char* option;
    bool applies;
    const char* needs;
  };
  const Rule rules[] = {
      {"--tooth", unit_load, "--calculix without --contact-forces"},
      {"--height", unit_load, "--calculix without --contact-forces"},
      {"--direction", unit_load, "--calculix without --contact-forces"},
      {"--contact-forces", !options.calculix.empty(), "--calculix"},
      {"--torque-nm", loaded, "--vtkhdf, or --calculix with --contact-forces"},
      {"--teeth", !options.profile.empty(), "--profile"},
      {"--points", !options.profile.empty(), "--profile"},
      {"--zeta", !options.profile.empty(), "--profile"},
  };
  for (const Rule& rule : rules) {
    if (!rule.applies &&
        std::find(options.given.begin(), options.given.end(), rule.option) != options.given.end())
      throw UsageError(fmt::format("{} has no effect here; it belongs to {}", rule.option, rule.needs));
  }
}

ExitCode export_gear(const ExportOptions& options) {
  if (options.calculix.empty() && options.vtkhdf.empty() && options.profile.empty() &&
      options.contact.empty())
    throw UsageError(
        "nothing to export; expected --calculix F.inp, --vtkhdf F.vtkhdf, --profile F.dxf (or F.csv) or "
        "--contact F.h5");
  if (!options.profile.empty() && !options.profile.ends_with(".dxf") && !options.profile.ends_with(".csv"))
    throw UsageError(fmt::format("--profile {}: the name must end in .dxf or .csv", options.profile));
  refuse_idle_options(options);
  const GearDocument document = load_gear(options.file);
  for (const std::string& warning : document.warnings)
    report(warning);
  Gear gear = document.gear;
  if (!options.torque_nm.empty()) {
    gear.load.rotation_rad.clear();
    gear.load.torque_nm = options.torque_nm;
  }
  for (const std::string& output : {options.calculix, options.vtkhdf, options.profile, options.contact})
    refuse_to_replace(output, {options.file, gear.wave_generator.table_file});
  if (const auto contradiction = find_contradiction(gear))
    return no_result(*contradiction);
  if (!options.calculix.empty())
    if (const ExitCode end = write_deck(gear, options); end != ExitCode::done)
      return end;
  if (!options.vtkhdf.empty())
    if (const ExitCode end = write_fields(gear, options); end != ExitCode::done)
      return end;
  if (!options.contact.empty())
    if (const ExitCode end = write_contact(gear, options); end != ExitCode::done)
      return end;
  return options.profile.empty() ? ExitCode::done : write_profile(gear, options);
}

} // namespace

void add_export(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("export", "Write a CalculiX deck, fields for ParaView, or tooth profiles for CAD");
  command->footer("docs/export.md says what is in each file.\n"
                  "Examples:  strainwave export mygear.toml --vtkhdf cup.vtkhdf --torque-nm 7\n"
                  "           strainwave export mygear.toml --calculix cup.inp --tooth 2 --height 1\n"
                  "           strainwave export mygear.toml --profile teeth.dxf --teeth 0 1 2 3");
  const auto o = std::make_shared<ExportOptions>();
  command->add_option("FILE", o->file, "A gear file (TOML)")->required();
  command->add_option("--calculix", o->calculix, "Finite-element deck of the whole cup (.inp)");
  command->add_option("--vtkhdf", o->vtkhdf,
                      "Displacement, contact forces and stress of the whole cup (.vtkhdf)");
  command->add_option("--profile", o->profile, "Outlines of teeth and spaces (.dxf or .csv)");
  command->add_option(
      "--contact", o->contact,
      "The contact problem itself, for other solvers: gaps, levers, compliance of every point and "
      "phase (.h5)");
  command->add_option("--tooth", o->load.tooth, "Deck: tooth that carries 1 N (default 0)");
  command
      ->add_option("--height", o->load.flank_height, "Deck: where on the flank, 0 root … 1 tip (default 0.5)")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--direction", o->direction, "Deck: circumferential (default) or radial")
      ->check(CLI::IsMember({"circumferential", "radial"}));
  command->add_flag("--contact-forces", o->contact_forces,
                    "Deck: the contact forces of assembly and loads instead, one step each");
  command
      ->add_option("--torque-nm", o->torque_nm,
                   "Fields, contact forces: torques instead of the file's [load], N·m")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--teeth", o->outlines.teeth, "Profile: assembled teeth (default: -10° … 20°)");
  command->add_option("--points", o->outlines.flank_points, "Profile: points on each flank (default 41)")
      ->check(CLI::Range(2, 100000));
  command
      ->add_option("--zeta", o->outlines.zeta,
                   "Profile: section of the face, -1 diaphragm end … 1 open end (default 0)")
      ->check(CLI::Range(-1.0, 1.0));
  command->add_flag("--no-cache", o->no_cache, "Neither read nor write the cache of solved cups");
  command->callback([&chosen, o, command] {
    for (const CLI::Option* option : command->get_options()) {
      if (option->count() > 0)
        o->given.push_back(option->get_name());
    }
    o->load.radial = o->direction == "radial";
    chosen = [o] { return export_gear(*o); };
  });
}

} // namespace strainwave::app
