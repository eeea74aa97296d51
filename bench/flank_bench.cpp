// How many heights and slices contact over the whole flank needs: peak force, rotation and zone of the
// gallery's seed_flank.toml and seed_coned.toml over flank_points, face_slices and mesh.along_face, as a
// table for docs/flank-contact.md, with the time of each (finite elements from the cache when it knows the
// cup: run twice). With the environment's STRAINWAVE_FIGURES = FOLDER the figure is drawn there as well.

#include "strainwave/model/export/figure.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <iterator>

namespace strainwave {
namespace {

struct Counts {
  int heights, slices, along_face;
};

struct Run {
  Counts counts;
  ForwardResult result;
  double load_ms = 0.0, fe_ms = 0.0;
};

Run analysed(Gear gear, Counts counts, ForwardModel& model) {
  gear.contact.flank_points = counts.heights;
  gear.contact.face_slices = counts.slices;
  gear.mesh.along_face = counts.along_face;
  Run run{counts, model.analyze(gear)};
  for (const Stage& stage : run.result.stages) {
    if (stage.name == "load")
      run.load_ms = 1e3 * stage.seconds;
    if (stage.name == "flexspline")
      run.fe_ms = 1e3 * stage.seconds;
  }
  return run;
}

void print(const std::vector<Run>& runs, const char* title) {
  fmt::print("\n### {}\n\n| flank_points × face_slices (along_face) | 1 N·m | 7 N·m | zone | 11.5 N·m | zone "
             "| rotation at 7 N·m | "
             "pressure at 7 N·m, flank / edges | finite elements | loads "
             "|\n|---|---|---|---|---|---|---|---|---|---|\n",
             title);
  for (const Run& run : runs) {
    if (run.result.status != Status::ok || run.result.load.size() != 3) {
      fmt::print("| {} × {} | {} |\n", run.counts.heights, run.counts.slices, run.result.message);
      continue;
    }
    const LoadResult &low = run.result.load[0], &rated = run.result.load[1], &high = run.result.load[2];
    fmt::print("| {} × {} ({}) | {:.2f} N | {:.2f} N | {:.1f} … {:.1f}° | {:.2f} N | {:.1f} … {:.1f}° | "
               "{:.4f} mrad | {:.0f} / "
               "{:.0f} MPa | {:.0f} ms | {:.0f} ms |\n",
               run.counts.heights, run.counts.slices, run.counts.along_face, low.peak_force_n,
               rated.peak_force_n, rated.engaged_lo_deg, rated.engaged_hi_deg, high.peak_force_n,
               high.engaged_lo_deg, high.engaged_hi_deg, 1e3 * rated.rotation_rad,
               rated.peak_flank_pressure.mpa, rated.peak_pressure.mpa, run.fe_ms, run.load_ms);
  }
  std::fflush(stdout);
}

/// Peak force over the finest run's, one panel for heights and one for slices.
std::string block(const std::vector<Run>& runs, bool heights) {
  std::string text;
  for (const Run& run : runs) {
    fmt::format_to(std::back_inserter(text), "{}", heights ? run.counts.heights : run.counts.slices);
    for (std::size_t k = 0; k < 3; ++k)
      fmt::format_to(std::back_inserter(text), " {:.5f}",
                     100.0 *
                         (run.result.load[k].peak_force_n / runs.back().result.load[k].peak_force_n - 1.0));
    text += "\n";
  }
  return text;
}

std::string panel(const std::string& name, int index, const char* x, const char* title) {
  std::string text =
      fmt::format("set xlabel '{}'\nset title '{}'\nplot 0 with lines linecolor '#909090' notitle", x, title);
  const char* labels[] = {"1 N·m", "7 N·m", "11.5 N·m"};
  for (std::size_t k = 0; k < 3; ++k)
    text += fmt::format(
        ", '{}.dat' index {} using 1:{} with linespoints linecolor '{}' linewidth 1.6 pointtype 7 pointsize "
        "0.5 title '{}'",
        name, index, k + 2, figure_colour(k), labels[k]);
  return text + "\n";
}

int bench() {
  ForwardModel model;
  const std::string gallery = STRAINWAVE_SOURCE "/studies/gallery/";
  const Gear flank = load_gear(gallery + "seed_flank.toml").gear;
  const Gear coned = load_gear(gallery + "seed_coned.toml").gear;
  const auto sweep = [&](const Gear& gear, const std::vector<Counts>& list) {
    std::vector<Run> runs;
    for (const Counts& counts : list)
      runs.push_back(analysed(gear, counts, model));
    return runs;
  };
  const std::vector<Counts> heights = {{3, 9, 6}, {5, 9, 6}, {9, 9, 6}, {13, 9, 6}, {17, 9, 6}, {25, 9, 6}};
  const std::vector<Counts> slices = {{9, 3, 6}, {9, 5, 6}, {9, 7, 6}, {9, 9, 6}, {9, 13, 6}, {9, 25, 12}};
  const std::vector<Counts> rows = {{9, 9, 6}, {9, 9, 8}, {9, 9, 12}};
  const auto flank_heights = sweep(flank, heights), flank_slices = sweep(flank, slices);
  print(flank_heights, "seed_flank.toml, heights");
  print(flank_slices, "seed_flank.toml, slices");
  print(sweep(flank, rows), "seed_flank.toml, elements along the face");
  const auto coned_heights = sweep(coned, heights), coned_slices = sweep(coned, slices);
  print(coned_heights, "seed_coned.toml, heights");
  print(coned_slices, "seed_coned.toml, slices");
  print(sweep(coned, rows), "seed_coned.toml, elements along the face");
  const char* folder = std::getenv("STRAINWAVE_FIGURES");
  if (!folder)
    return 0;
  for (const auto* runs : {&flank_heights, &flank_slices, &coned_heights, &coned_slices})
    for (const Run& run : *runs)
      if (run.result.load.size() != 3)
        return 1;
  Figure figure{.name = "flank-convergence", .data = {}, .drawing = {}, .width = 900, .height = 660};
  figure.data = "# peak force against the finest run [%]: heights or slices, 1, 7, 11.5 N.m\n" +
                block(flank_heights, true) + "\n\n" + block(flank_slices, false) + "\n\n" +
                block(coned_heights, true) + "\n\n" + block(coned_slices, false);
  figure.drawing =
      "set multiplot layout 2,2\nset yrange [-5:25]\nset ytics 5\nset xrange [2:26]\n"
      "set ylabel 'peak force against the finest [%]'\nset xtics (3,5,9,13,17,25)\nset key top center\n" +
      panel(figure.name, 0, "heights of the flank, with 9 slices", "kinematic gaps") +
      panel(figure.name, 1, "slices across the face, with 9 heights", "kinematic gaps") +
      panel(figure.name, 2, "heights of the flank, with 9 slices", "coned cup") +
      panel(figure.name, 3, "slices across the face, with 9 heights", "coned cup") + "unset multiplot\n";
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
