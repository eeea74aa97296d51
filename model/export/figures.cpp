#include "strainwave/model/export/figures.hpp"

#include "strainwave/common/core/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace strainwave {

namespace {

using units::degree;
constexpr const char* angle_label = "material angle of the tooth from the major axis, φ [°]";

std::string number(double value) {
  value += 0.0; // no −0
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "nan";
}

/// "7 N·m", "7 N·m, coast", with what was asked for in the result's own numbers.
std::string load_label(const LoadResult& load) {
  return fmt::format("{:.4g} N·m{}", load.torque_nm, load.direction == Direction::coast ? ", coast" : "");
}

/// "plot 'NAME.dat' index K using 1:2 with …" for several curves.
class Plot {
public:
  explicit Plot(std::string data_file) : file(std::move(data_file)) {}
  void add(std::size_t block, const std::string& columns, const std::string& style,
           const std::string& title) {
    text += fmt::format("{}'{}.dat' index {} using {} {} {}", text.empty() ? "plot " : ", \\\n     ", file,
                        block, columns, style, title.empty() ? "notitle" : "title '" + title + "'");
  }
  std::string command() const { return text + "\n"; }

private:
  std::string file, text;
};

std::string curve(std::size_t index, const char* point = "7") {
  return fmt::format("with linespoints linecolor '{}' linewidth 1.6 pointtype {} pointsize 0.5",
                     figure_colour(index), point);
}

/// From `margin` pitches before the first tooth that carries load to as many behind the last, over all loads.
struct AngleRange {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
};
AngleRange engaged_range(const ForwardResult& result, double margin) {
  AngleRange range;
  double margin_deg = 0.0;
  for (const LoadResult& load : result.load) {
    if (load.engaged_count == 0)
      continue;
    if (load.phi_deg.size() > 1)
      margin_deg = margin * (load.phi_deg[1] - load.phi_deg[0]);
    range.lo = std::min(range.lo, load.engaged_lo_deg);
    range.hi = std::max(range.hi, load.engaged_hi_deg);
  }
  if (!(range.lo <= range.hi))
    return {-90.0, 90.0};
  return {std::max(-180.0, 5.0 * std::floor((range.lo - margin_deg) / 5.0)),
          std::min(180.0, 5.0 * std::ceil((range.hi + margin_deg) / 5.0))};
}

} // namespace

std::vector<Figure> backlash_figures(const ForwardResult& result) {
  if (!result.backlash)
    return {};
  const BacklashResult& b = *result.backlash;
  Figure figure{.name = "initial-backlash", .data = {}, .drawing = {}, .width = 960, .height = 400};
  const double near_deg =
      std::max(20.0, std::fabs(b.min_phi_deg) + 10.0); // the teeth that meet first, once more
  auto out = std::back_inserter(figure.data);
  fmt::format_to(
      out,
      "# {}: initial backlash, an arc at the contact radius\n"
      "# tooth  phi [deg]  drive flank [um]  coast flank [um]  contact radius of the drive flank [mm]\n",
      result.gear);
  for (std::size_t i = 0; i < b.tooth.size(); ++i)
    fmt::format_to(out, "{} {} {} {} {}\n", b.tooth[i], number(b.phi_deg[i]), number(b.backlash_um[i]),
                   number(b.coast_backlash_um[i]), number(b.contact_radius_mm[i]));
  Plot plot(figure.name), near(figure.name);
  plot.add(0, "2:3", curve(0), "drive flank");
  plot.add(0, "2:4", curve(1, "6"), "coast flank");
  near.add(0, "2:3", curve(0), "");
  near.add(0, "2:4", curve(1, "6"), "");
  figure.drawing = fmt::format(
      "set multiplot layout 1,2\nset xlabel 'material angle of the tooth, φ [°]'\n"
      "set ylabel 'initial backlash [µm]'\nset xzeroaxis linetype 1 linecolor '#909090'\n"
      "set key top center\nset xtics 15\n{0}"
      "set xrange [{1}:{2}]\nset xtics 5\nset autoscale y\nset offsets 0,0,0,graph 0.1\n"
      "set label 1 'least {3:+.2f} µm at {4:.2f}°' at {4:.9g},{3:.9g} offset character 0,-1 center "
      "textcolor '{5}'\n{6}unset multiplot\n",
      plot.command(), number(-near_deg), number(near_deg), b.min_um, b.min_phi_deg, figure_colour(0),
      near.command());
  return {figure};
}

std::vector<Figure> load_figures(const ForwardResult& result) {
  if (result.load.empty())
    return {};
  Figure forces{.name = "meshing-forces", .data = {}, .drawing = {}};
  Figure gaps{.name = "loaded-backlash", .data = {}, .drawing = {}};
  auto force_out = std::back_inserter(forces.data);
  auto gap_out = std::back_inserter(gaps.data);
  fmt::format_to(force_out, "# {}: force on each tooth of one lobe; one block for each load\n", result.gear);
  fmt::format_to(gap_out,
                 "# {}: backlash left under load, 0 where a tooth carries; one block for each load\n",
                 result.gear);
  Plot force_plot(forces.name), gap_plot(gaps.name);
  std::size_t gap_block = 0;
  if (const auto& b = result.backlash; b && result.load.front().direction == Direction::drive) {
    fmt::format_to(gap_out, "# no load: initial backlash\n# tooth  phi [deg]  backlash [um]\n");
    for (std::size_t i = 0; i < b->tooth.size(); ++i)
      fmt::format_to(gap_out, "{} {} {}\n", b->tooth[i], number(b->phi_deg[i]), number(b->backlash_um[i]));
    gap_plot.add(gap_block++, "2:3", "with lines linecolor '#808080' linewidth 1.2 dashtype 2", "no load");
  }
  for (std::size_t k = 0; k < result.load.size(); ++k) {
    const LoadResult& load = result.load[k];
    const std::string head =
        fmt::format("# torque {} N.m, rotation {} rad, {}, meshing phase {}\n# tooth  phi [deg]  ",
                    number(load.torque_nm), number(load.rotation_rad),
                    load.direction == Direction::coast ? "coast" : "drive", number(load.peak_phase));
    fmt::format_to(force_out, "{}{}force [N]\n", k == 0 ? "" : "\n\n", head);
    fmt::format_to(gap_out, "{}{}loaded backlash [um]\n", gap_block == 0 ? "" : "\n\n", head);
    for (std::size_t i = 0; i < load.tooth.size(); ++i) {
      fmt::format_to(force_out, "{} {} {}\n", load.tooth[i], number(load.phi_deg[i]),
                     number(load.force_n[i]));
      fmt::format_to(gap_out, "{} {} {}\n", load.tooth[i], number(load.phi_deg[i]),
                     number(load.loaded_backlash_um[i]));
    }
    force_plot.add(k, "2:3", curve(k), load_label(load));
    gap_plot.add(gap_block++, "2:3", curve(k), load_label(load));
  }
  const AngleRange near = engaged_range(result, 1.0), wide = engaged_range(result, 6.0);
  forces.drawing = fmt::format("set xlabel '{}'\nset ylabel 'meshing force of a tooth [N]'\n"
                               "set xrange [{}:{}]\nset yrange [0:*]\nset xtics 5\n{}",
                               angle_label, number(near.lo), number(near.hi), force_plot.command());
  Figure pressure{.name = "contact-pressure", .data = {}, .drawing = {}};
  auto pressure_out = std::back_inserter(pressure.data);
  fmt::format_to(pressure_out,
                 "# {}: largest contact pressure of each tooth of one lobe; one block for each load\n",
                 result.gear);
  Plot pressure_plot(pressure.name);
  for (std::size_t k = 0; k < result.load.size(); ++k) {
    const LoadResult& load = result.load[k];
    fmt::format_to(pressure_out, "{}# torque {} N.m, {}\n# tooth  phi [deg]  pressure [MPa]\n",
                   k == 0 ? "" : "\n\n", number(load.torque_nm),
                   load.direction == Direction::coast ? "coast" : "drive");
    for (std::size_t i = 0; i < load.tooth.size(); ++i)
      fmt::format_to(pressure_out, "{} {} {}\n", load.tooth[i], number(load.phi_deg[i]),
                     number(load.pressure_mpa[i]));
    pressure_plot.add(k, "2:3", curve(k), load_label(load));
  }
  pressure.drawing = fmt::format("set xlabel '{}'\nset ylabel 'contact pressure of a tooth [MPa]'\n"
                                 "set xrange [{}:{}]\nset yrange [0:*]\nset xtics 5\n{}",
                                 angle_label, number(near.lo), number(near.hi), pressure_plot.command());
  gaps.drawing = fmt::format("set xlabel '{}'\nset ylabel 'loaded backlash [µm]'\n"
                             "set xrange [{}:{}]\nset yrange [0:*]\nset xtics 10\nset key top center\n{}",
                             angle_label, number(wide.lo), number(wide.hi), gap_plot.command());
  return {forces, gaps, pressure};
}

std::vector<double> sweep_rotations_rad(const ForwardResult& result, int count) {
  double largest = 0.0;
  for (const LoadResult& load : result.load)
    largest = std::max(largest, load.rotation_rad);
  std::vector<double> rotations;
  for (int k = 0; k < count && largest > 0.0; ++k)
    rotations.push_back(1.05 * largest * k / (count - 1));
  return rotations;
}

namespace {

/// Three blocks: teeth that begin to carry, teeth that cease to, all other events. Numbers of the teeth
/// beside their marks, where there are few.
void mark_events(const LoadPath& path, std::size_t block, Plot& plot, std::string& data) {
  auto out = std::back_inserter(data);
  std::string begin, cease, other;
  int begun = 0;
  for (const LoadPathEvent& event : path.events) {
    const std::string place = fmt::format("{} {} {}", number(1e3 * event.rotation_rad),
                                          number(event.torque_nm), number(event.stiffness_nm_per_rad));
    std::string teeth[2]; // that cease, that begin
    for (const LoadPathChange& change : event.changes)
      if (change.whole_tooth)
        teeth[change.joins] +=
            fmt::format("{}{}", teeth[change.joins].empty() ? "" : ",", change.point.tooth);
    if (!teeth[1].empty())
      begin += fmt::format("{} {}\n", place, teeth[1]), ++begun;
    if (!teeth[0].empty())
      cease += fmt::format("{} {}\n", place, teeth[0]);
    if (teeth[0].empty() && teeth[1].empty())
      other += place + "\n";
  }
  const auto add = [&](const char* head, const std::string& rows, const std::string& style,
                       const char* title) {
    fmt::format_to(out, "\n\n# {}\n# rotation [mrad]  torque [N.m]  stiffness after it [N.m/rad]\n{}", head,
                   rows.empty() ? "nan nan nan nan\n" : rows);
    if (!rows.empty())
      plot.add(block, "1:2", style, title);
    ++block;
  };
  add("other events of the path: a further point of a tooth, a place of the wall", other,
      "with points linecolor '#707070' pointtype 2 pointsize 0.35", "another point or the wall changes");
  add("a tooth begins to carry; its number", begin,
      fmt::format("with points linecolor '{}' pointtype 9 pointsize 0.9", figure_colour(2)),
      "a tooth begins to carry");
  if (begun > 0 && begun <= 24) { // by turns above and below the curve: neighbours stand close
    const std::string label = fmt::format("font ',9' textcolor '{}'", figure_colour(2));
    plot.add(block - 1, "1:2:4 every 2", "with labels right offset character -0.8,0.4 " + label, "");
    if (begun > 1)
      plot.add(block - 1, "1:2:4 every 2::1", "with labels left offset character 0.8,-0.4 " + label, "");
  }
  add("a tooth ceases to carry; its number", cease,
      fmt::format("with points linecolor '{}' pointtype 11 pointsize 0.9", figure_colour(3)),
      "a tooth ceases to carry");
}

} // namespace

Figure torque_rotation_figure(const ForwardResult& result, const ForwardResult& sweep, const LoadPath* path) {
  Figure figure{.name = "torque-rotation", .data = {}, .drawing = {}};
  auto out = std::back_inserter(figure.data);
  fmt::format_to(out,
                 "# {}: torque of both lobes over the rotation of the circular spline\n"
                 "# rotation [mrad]  torque [N.m]  tangent stiffness [N.m/rad]\n",
                 result.gear);
  Plot plot(figure.name);
  std::size_t block = 0;
  for (const Direction direction : {Direction::drive, Direction::coast}) {
    bool any = false;
    for (const LoadResult& load : sweep.load) {
      if (load.direction != direction)
        continue;
      if (!any)
        fmt::format_to(out, "{}# {}\n", block == 0 ? "" : "\n\n",
                       direction == Direction::coast ? "coast" : "drive");
      any = true;
      fmt::format_to(out, "{} {} {}\n", number(1e3 * load.rotation_rad), number(load.torque_nm),
                     number(load.tangent_stiffness_nm_per_rad));
    }
    if (!any)
      continue;
    plot.add(block, "1:2", fmt::format("with lines linecolor '{}' linewidth 1.8", figure_colour(block)),
             direction == Direction::coast ? "coast" : "drive");
    ++block;
  }
  fmt::format_to(out, "\n\n# the loads asked for\n");
  for (const LoadResult& load : result.load)
    fmt::format_to(out, "{} {} {}\n", number(1e3 * load.rotation_rad), number(load.torque_nm),
                   number(load.tangent_stiffness_nm_per_rad));
  plot.add(block, "1:2",
           fmt::format("with points linecolor '{}' pointtype 7 pointsize 0.7", figure_colour(1)),
           "loads of the gear");
  if (path)
    mark_events(*path, block + 1, plot, figure.data);
  figure.drawing = fmt::format(
      "set xlabel 'rotation of the circular spline [mrad]'\nset ylabel 'torque, both lobes [N·m]'\n"
      "set xrange [0:*]\nset yrange [0:*]\nset key top left reverse Left\n{}",
      plot.command());
  return figure;
}

Figure assembled_shape_figure(const ContactForces& assembled) {
  Figure figure{.name = "assembled-shape", .data = {}, .drawing = {}, .width = 760, .height = 640};
  auto out = std::back_inserter(figure.data);
  fmt::format_to(
      out, "# inner wall of the flexspline on the wave generator; one block for each row across the discs\n");
  int rows = 0;
  for (const WallContact& wall : assembled.wall)
    rows = std::max(rows, wall.station.row + 1);
  Plot shape(figure.name), force(figure.name);
  for (int row = 0; row < rows; ++row) {
    bool first = true;
    double z = 0.0;
    for (const WallContact& wall : assembled.wall) {
      if (wall.station.row != row)
        continue;
      z = wall.station.z_mm;
      if (first)
        fmt::format_to(out,
                       "{}# z = {} mm from the diaphragm\n# phi [deg]  radial displacement [mm]  "
                       "circumferential displacement [mm]  contact force, radial [N]  circumferential [N]\n",
                       row == 0 ? "" : "\n\n", number(z));
      first = false;
      fmt::format_to(out, "{} {} {} {} {}\n", number(wall.station.phi_rad / degree), number(wall.radial_mm),
                     number(wall.circumferential_mm), number(wall.radial_n), number(wall.circumferential_n));
    }
    const auto index = static_cast<std::size_t>(row);
    shape.add(index, "1:2", fmt::format("with lines linecolor '{}' linewidth 1.6", figure_colour(index)),
              fmt::format("z = {:g} mm", z));
    force.add(index, "1:($4 > 0 ? $4 : 1/0)",
              fmt::format("with impulses linecolor '{}' linewidth 2", figure_colour(index)), "");
  }
  figure.drawing =
      fmt::format("set multiplot layout 2,1\nset xrange [-90:90]\nset xtics 15\nset lmargin 11\n"
                  "set ylabel 'radial displacement of the wall [mm]'\nset key bottom center\n{}"
                  "set xlabel 'material angle from the major axis, φ [°]'\n"
                  "set ylabel 'radial contact force at a station [N]'\nset yrange [0:*]\n{}unset multiplot\n",
                  shape.command(), force.command());
  return figure;
}

} // namespace strainwave
