// What modifications across the face do to the coned seed gear: peak force, pressure, rotation of the
// gallery's seed_coned.toml over lead taper, lead crowning, end relief and disc taper, as tables for
// docs/flank-contact.md. For each the profile shift x2 is set anew so that the least backlash of the
// assembled cup stays 1 µm: rotations compare at the same clearance. With STRAINWAVE_FIGURES = FOLDER the
// figure is drawn there as well.

#include "strainwave/model/export/figure.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <functional>
#include <iterator>

namespace strainwave {
namespace {

struct Line {
  double value = 0.0, x2 = 0.0;
  ForwardResult result;
};

/// ∂c/∂x2 = 75.8 µm per unit: one step is enough but for the last nanometres.
Line at_least_backlash(Gear gear, double value, ForwardModel& model) {
  constexpr double wanted_um = 1.0, slope_um = 75.8;
  ForwardResult result;
  for (int step = 0; step < 2; ++step) {
    result = model.analyze(gear, Want::compliance);
    if (!result.backlash || !result.backlash->assembled)
      return {value, gear.circular_spline.profile_shift, result};
    gear.circular_spline.profile_shift += (wanted_um - result.backlash->assembled->min_um) / slope_um;
  }
  return {value, gear.circular_spline.profile_shift, model.analyze(gear)};
}

std::vector<Line> over(const Gear& base, const std::vector<double>& values,
                       const std::function<void(Gear&, double)>& set, const char* title,
                       ForwardModel& model) {
  fmt::print("\n### {}\n\n| µm | x2 | least backlash at | 1 N·m | 7 N·m | pressure, flank / edges | rotation "
             "| zone | 11.5 N·m | "
             "pressure, flank / edges |\n|---|---|---|---|---|---|---|---|---|---|\n",
             title);
  std::vector<Line> lines;
  for (const double value : values) {
    Gear gear = base;
    set(gear, value);
    Line line = at_least_backlash(gear, value, model);
    const ForwardResult& r = line.result;
    if (r.status != Status::ok || r.load.size() != 3) {
      fmt::print("| {:g} | {:.4f} | {} |\n", value, line.x2, r.message);
      continue;
    }
    const LoadResult &rated = r.load[1], &high = r.load[2];
    fmt::print("| {:g} | {:.4f} | {:.1f}°, z = {:.1f} | {:.2f} N | {:.2f} N | {:.0f} / {:.0f} MPa | {:.4f} "
               "mrad | {:.1f} … {:.1f}° | "
               "{:.2f} N | {:.0f} / {:.0f} MPa |\n",
               value, line.x2, r.backlash->assembled->min_phi_deg, r.backlash->assembled->min_z_mm,
               r.load[0].peak_force_n, rated.peak_force_n, rated.peak_flank_pressure.mpa,
               rated.peak_pressure.mpa, 1e3 * rated.rotation_rad, rated.engaged_lo_deg, rated.engaged_hi_deg,
               high.peak_force_n, high.peak_flank_pressure.mpa, high.peak_pressure.mpa);
    std::fflush(stdout);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string block(const std::vector<Line>& lines) {
  std::string text;
  for (const Line& line : lines) {
    fmt::format_to(std::back_inserter(text), "{} {:.6g} {:.6g} {:.6g} {:.6g}\n", line.value,
                   line.result.load[1].peak_force_n, line.result.load[2].peak_force_n,
                   line.result.load[1].peak_flank_pressure.mpa, line.result.load[1].peak_pressure.mpa);
  }
  return text;
}

int bench() {
  ForwardModel model;
  const Gear base = load_gear(STRAINWAVE_SOURCE "/studies/gallery/seed_coned.toml").gear;
  std::vector<double> tapers, crownings;
  for (int k = -16; k <= 26; k += 1)
    tapers.push_back(k);
  for (int k = 0; k <= 20; ++k)
    crownings.push_back(k);
  const auto taper = over(
      base, tapers, [](Gear& g, double v) { g.flank_modification.flexspline.lead_taper_um = v; },
      "flank_modification.flexspline.lead_taper_um", model);
  const auto crowning = over(
      base, crownings, [](Gear& g, double v) { g.flank_modification.flexspline.lead_crowning_um = v; },
      "flank_modification.flexspline.lead_crowning_um", model);
  const auto relief = over(
      base, {0, 2, 4, 6, 8, 10, 12, 15, 20},
      [](Gear& g, double v) {
        g.flank_modification.flexspline.end_relief_um = v;
        g.flank_modification.flexspline.end_relief_length_mm = 2.0;
      },
      "flank_modification.flexspline.end_relief_um, 2 mm long", model);
  const auto disc = over(
      base, {-30, -25, -20, -15, -10, -5, 0, 5, 10, 15, 20},
      [](Gear& g, double v) { g.wave_generator.disc_taper_um = v; }, "wave_generator.disc_taper_um", model);
  const char* folder = std::getenv("STRAINWAVE_FIGURES");
  if (!folder)
    return 0;
  Figure figure{.name = "face-modifications", .data = {}, .drawing = {}, .width = 960, .height = 660};
  figure.data = "# coned seed gear; one block each: lead taper, lead crowning, end relief, disc taper\n"
                "# amount [um]  peak force at 7, 11.5 N.m [N]  pressure at 7 N.m, flank, edges too [MPa]\n" +
                block(taper) + "\n\n" + block(crowning) + "\n\n" + block(relief) + "\n\n" + block(disc);
  figure.drawing = "set multiplot layout 2,2\nset border 11\nset yrange [0:120]\nset ytics nomirror 0,20,80\n"
                   "set ylabel 'peak force of a tooth [N]' offset 0,-2\nset y2range [0:9]\nset y2tics 0,1,5\n"
                   "set y2label 'pressure, edges too [GPa]' offset -1,-2\nset key top right\n";
  const char* names[] = {"lead taper [µm], above 0: removed at the open end", "lead crowning [µm]",
                         "end relief over 2 mm [µm]", "disc taper [µm], above 0: wider at the open end"};
  for (int k = 0; k < 4; ++k) {
    const std::string curves =
        fmt::format("'{0}.dat' index {1} using 1:2 with {2} linecolor '{3}' title '7 N·m', '' index {1} "
                    "using 1:3 with {2} linecolor "
                    "'{4}' title '11.5 N·m', '' index {1} using 1:($5/1000) axes x1y2 with lines dashtype 2 "
                    "linewidth 1.4 linecolor "
                    "'{5}' title 'pressure at 7 N·m'",
                    figure.name, k, "linespoints linewidth 1.6 pointtype 7 pointsize 0.5", figure_colour(0),
                    figure_colour(2), figure_colour(1));
    figure.drawing += fmt::format("set xlabel '{}'\nplot {}\n", names[k], curves);
  }
  figure.drawing += "unset multiplot\n";
  const Drawn drawn = draw({figure}, folder);
  if (!drawn.complete)
    fmt::print(stderr, "{}\n", drawn.note);
  return 0;
}

} // namespace
} // namespace strainwave

int main() {
  return strainwave::bench();
}
