#include "strainwave/model/export/flank_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

namespace strainwave {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_panels = 4;

/// From nearly white to dark: light where nothing is.
constexpr const char* rising =
    "set palette defined (0 '#f4f4f2', 0.15 '#d6e6f2', 0.4 '#7fb8dc', 0.7 '#0072B2', 1 '#052c4a')\n";
/// The other way round: dark where the gap is closed.
constexpr const char* falling =
    "set palette defined (0 '#052c4a', 0.3 '#0072B2', 0.6 '#7fb8dc', 0.85 '#d6e6f2', 1 '#f4f4f2')\n";

std::string number(double value) {
  value += 0.0;
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "nan";
}

std::string load_label(const LoadResult& load) {
  return fmt::format("{:.4g} N·m{}", load.torque_nm, load.direction == Direction::coast ? ", coast" : "");
}

/// Boundaries of the shares that equidistant hats over [lo, hi] stand for: half-way between their peaks.
std::vector<double> shares(double lo, double hi, std::size_t count) {
  std::vector<double> ends = {lo};
  for (std::size_t k = 0; k + 1 < count; ++k)
    ends.push_back(lo + (hi - lo) * (static_cast<double>(k) + 0.5) / static_cast<double>(count - 1));
  ends.push_back(hi);
  return ends;
}

/// Boundaries between places of any spacing; the outer ones end at lo and hi.
std::vector<double> shares(const std::vector<double>& places, double lo, double hi) {
  std::vector<double> ends = {lo};
  for (std::size_t k = 1; k < places.size(); ++k)
    ends.push_back(0.5 * (places[k - 1] + places[k]));
  ends.push_back(hi);
  return ends;
}

struct Box {
  double x_lo, x_hi, y_lo, y_hi, value;
};

std::string box_lines(const std::vector<Box>& boxes) {
  std::string text;
  for (const Box& b : boxes) {
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {} {}\n", number(0.5 * (b.x_lo + b.x_hi)),
                   number(0.5 * (b.y_lo + b.y_hi)), number(b.x_lo), number(b.x_hi), number(b.y_lo),
                   number(b.y_hi), number(b.value));
  }
  return text;
}

std::string draw_boxes(const std::string& name, std::size_t block) {
  return fmt::format(
      "plot '{}.dat' index {} using 1:2:3:4:5:6:7 with boxxyerror fillstyle solid 1.0 noborder "
      "linecolor palette notitle\n",
      name, block);
}

/// The face of one gear: its ends and the slices of its contact points.
struct Face {
  explicit Face(const Gear& gear)
      : hi(gear.flexspline.cup_length_mm - gear.flexspline.front_clearance_mm),
        lo(hi - gear.flexspline.face_width_mm),
        slice_ends(gear.contact.face_slices > 1
                       ? shares(lo, hi, static_cast<std::size_t>(gear.contact.face_slices))
                       : std::vector<double>{lo, hi}) {}
  std::size_t slice(double z) const {
    const auto above = std::upper_bound(slice_ends.begin() + 1, slice_ends.end() - 1, z);
    return static_cast<std::size_t>(above - slice_ends.begin()) - 1;
  }
  std::size_t slices() const { return slice_ends.size() - 1; }
  double hi, lo;
  std::vector<double> slice_ends;
};

/// What a tooth and slice show of their points.
enum class Shown { line_load, gap, pressure };

std::vector<Box> tooth_map(const LoadResult& load, const Face& face, Shown shown) {
  const double half_pitch = load.phi_deg.size() > 1 ? 0.5 * (load.phi_deg[1] - load.phi_deg[0]) : 1.0;
  std::map<int, double> phi_of;
  for (std::size_t i = 0; i < load.tooth.size(); ++i)
    phi_of[load.tooth[i]] = load.phi_deg[i];
  std::map<std::pair<double, std::size_t>, double> value;
  const PointResults& p = load.points;
  for (std::size_t i = 0; i < p.tooth.size(); ++i) {
    const std::size_t slice = face.slice(p.z_mm[i]);
    const double share = face.slice_ends[slice + 1] - face.slice_ends[slice];
    const double own = shown == Shown::line_load ? p.force_n[i] / share
                       : shown == Shown::gap     ? p.gap_um[i]
                                                 : p.pressure_mpa[i];
    const auto [at, fresh] = value.try_emplace({phi_of.at(p.tooth[i]), slice}, own);
    if (fresh)
      continue;
    at->second = shown == Shown::line_load ? at->second + own
                 : shown == Shown::gap     ? std::min(at->second, own)
                                           : std::max(at->second, own);
  }
  std::vector<Box> boxes;
  for (const auto& [at, v] : value)
    boxes.push_back({at.first - half_pitch, at.first + half_pitch, face.slice_ends[at.second],
                     face.slice_ends[at.second + 1], v});
  return boxes;
}

/// Material angles worth showing: the teeth that carry load at any of the loads, and some beside them.
std::pair<double, double> shown_angles(const std::vector<const LoadResult*>& loads) {
  double lo = 1e9, hi = -1e9;
  for (const LoadResult* load : loads) {
    if (load->engaged_count == 0)
      continue;
    const double pitch = load->phi_deg.size() > 1 ? load->phi_deg[1] - load->phi_deg[0] : 2.0;
    lo = std::min(lo, load->engaged_lo_deg - 3.5 * pitch);
    hi = std::max(hi, load->engaged_hi_deg + 3.5 * pitch);
  }
  return lo < hi ? std::pair{lo, hi} : std::pair{-90.0, 90.0};
}

/// One map with a panel for each load, over each other.
Figure map_figure(const std::string& name, const ForwardResult& result,
                  const std::vector<const LoadResult*>& loads, const Face& face, Shown shown,
                  const std::string& what, const std::string& unit) {
  const std::size_t panels = loads.size();
  Figure figure{
      .name = name, .data = {}, .drawing = {}, .width = 860, .height = 90 + 205 * static_cast<int>(panels)};
  const auto [lo, hi] = shown_angles(loads);
  auto data = std::back_inserter(figure.data);
  auto drawing = std::back_inserter(figure.drawing);
  fmt::format_to(data, "# {}: {} [{}]; one block for each load\n", result.gear, what, unit);
  fmt::format_to(drawing,
                 "{}set multiplot layout {},1 margins 0.09,0.86,{:.3f},{:.3f} spacing 0,{:.3f}\n"
                 "set xrange [{}:{}]\nset yrange [{}:{}]\nset ylabel 'z from the diaphragm [mm]'\n"
                 "set xtics 5\nset ytics {}\nset border 15\nset cblabel '{} [{}]'\nunset grid\n",
                 shown == Shown::gap ? falling : rising, panels, 62.0 / figure.height,
                 1.0 - 32.0 / figure.height, 58.0 / figure.height, number(lo), number(hi), number(face.lo),
                 number(face.hi), number(std::pow(10.0, std::floor(std::log10(0.5 * (face.hi - face.lo))))),
                 what, unit);
  for (std::size_t k = 0; k < panels; ++k) {
    const LoadResult& load = *loads[k];
    std::vector<Box> boxes = tooth_map(load, face, shown);
    std::erase_if(boxes, [lo = lo, hi = hi](const Box& b) { return b.x_hi < lo || b.x_lo > hi; });
    fmt::format_to(data,
                   "{}# torque {} N.m, {}, meshing phase {}\n# phi [deg]  z [mm]  phi from  phi to  z from  "
                   "z to  {} [{}]\n{}",
                   k == 0 ? "" : "\n\n", number(load.torque_nm),
                   load.direction == Direction::coast ? "coast" : "drive", number(load.peak_phase), what,
                   unit, box_lines(boxes));
    fmt::format_to(
        drawing, "set cbrange [0:{}]\nset label 1 '{}' at graph 0,1 offset character 0,0.7 left\n{}{}",
        shown == Shown::gap ? "10" : "*", load_label(load),
        k + 1 == panels ? "set xlabel 'material angle of the tooth from the major axis, φ [°]'\n" : "",
        draw_boxes(name, k));
  }
  figure.drawing += "unset multiplot\n";
  return figure;
}

/// Force and pressure of one tooth's flank.
Figure tooth_figure(const ForwardResult& result, const LoadResult& load, const Gear& gear, const Face& face) {
  std::size_t at = 0;
  for (std::size_t i = 1; i < load.tooth.size(); ++i) {
    if (load.force_n[i] > load.force_n[at])
      at = i;
  }
  const PointResults& p = load.points;
  std::vector<std::vector<std::pair<double, std::size_t>>> columns(
      face.slices()); // (radius, point) of each slice
  double lowest = gear.flexspline.tip_radius_mm;
  for (std::size_t i = 0; i < p.tooth.size(); ++i) {
    if (p.tooth[i] != load.tooth[at])
      continue;
    columns[face.slice(p.z_mm[i])].emplace_back(p.flank_radius_mm[i], i);
    lowest = std::min(lowest, p.flank_radius_mm[i]);
  }
  if (gear.contact.flank_points == 1)
    lowest = gear.flexspline.root_radius_mm;
  std::vector<Box> force, pressure;
  for (std::size_t slice = 0; slice < columns.size(); ++slice) {
    auto& column = columns[slice];
    std::sort(column.begin(), column.end());
    std::vector<double> radius;
    for (const auto& [r, i] : column)
      radius.push_back(r);
    if (radius.empty())
      continue;
    const double bottom = gear.contact.flank_points == 1 ? lowest : radius.front();
    const std::vector<double> ends = shares(radius, bottom, gear.flexspline.tip_radius_mm);
    for (std::size_t k = 0; k < column.size(); ++k) {
      const Box box{face.slice_ends[slice], face.slice_ends[slice + 1], ends[k], ends[k + 1],
                    p.force_n[column[k].second]};
      force.push_back(box);
      pressure.push_back(box);
      pressure.back().value = p.pressure_mpa[column[k].second];
    }
  }
  Figure figure{.name = "tooth-flank", .data = {}, .drawing = {}, .width = 980, .height = 420};
  fmt::format_to(std::back_inserter(figure.data),
                 "# {}: drive flank of tooth {} at phi = {} deg, torque {} N.m\n"
                 "# z [mm]  radius on the undeformed flexspline [mm]  z from  z to  radius from  radius to  "
                 "force [N]\n{}"
                 "\n\n# the same places  pressure [MPa]\n{}",
                 result.gear, load.tooth[at], number(load.phi_deg[at]), number(load.torque_nm),
                 box_lines(force), box_lines(pressure));
  figure.drawing = fmt::format(
      "{}set multiplot layout 1,2 margins 0.09,0.90,0.17,0.88 spacing 0.19,0\nset border 15\nunset grid\n"
      "set xrange [{}:{}]\nset yrange [{}:{}]\nset format y '%.2f'\nset cbrange [0:*]\n"
      "set xlabel 'z from the diaphragm [mm]'\nset ylabel 'radius on the flank [mm]'\n"
      "set label 1 'tooth at φ = {:.2f}°, {:.4g} N in all, {}' at graph 0,1 offset character 0,0.8 left\n"
      "set cblabel 'force of a point [N]'\n{}unset label 1\nunset ylabel\nset cblabel 'contact pressure "
      "[MPa]'\n{}unset multiplot\n",
      rising, number(face.lo), number(face.hi), number(lowest), number(gear.flexspline.tip_radius_mm),
      load.phi_deg[at], load.force_n[at], load_label(load), draw_boxes(figure.name, 0),
      draw_boxes(figure.name, 1));
  return figure;
}

Figure backlash_map(const ForwardResult& result, const AssembledBacklash& b) {
  Figure figure{.name = "backlash-map", .data = {}, .drawing = {}, .width = 860, .height = 380};
  const double lo = std::max(b.phi_deg.front(), b.min_phi_deg - 32.0),
               hi = std::min(b.phi_deg.back(), b.min_phi_deg + 38.0);
  auto data = std::back_inserter(figure.data);
  fmt::format_to(data,
                 "# {}: initial backlash of the drive flank over the face of the assembled cup\n"
                 "# phi [deg]  z [mm]  backlash [um]\n",
                 result.gear);
  double most = b.min_um;
  for (std::size_t k = 0; k < b.z_mm.size(); ++k) {
    for (std::size_t i = 0; i < b.phi_deg.size(); ++i) {
      fmt::format_to(data, "{} {} {}\n", number(b.phi_deg[i]), number(b.z_mm[k]),
                     number(b.backlash_um[k][i]));
      if (b.phi_deg[i] >= lo && b.phi_deg[i] <= hi && b.backlash_um[k][i] > most)
        most = b.backlash_um[k][i];
    }
    fmt::format_to(data, "\n");
  }
  const double step = most - b.min_um > 25.0 ? 5.0 : most - b.min_um > 10.0 ? 2.0 : 1.0;
  const double first = step * std::ceil(b.min_um / step);
  const double top = std::min(most, b.min_um + 12.0 * step);
  fmt::format_to(std::back_inserter(figure.data), "\n# least\n{} {} {}\n", number(b.min_phi_deg),
                 number(b.min_z_mm), number(b.min_um));
  figure.drawing = fmt::format(
      "{0}set view map\nset lmargin at screen 0.1\nset rmargin at screen 0.84\nset tmargin at screen 0.88\n"
      "set bmargin at screen 0.2\nset border 15\nunset grid\nunset key\n"
      "set xrange [{1}:{2}]\nset yrange [{3}:{4}]\nset cbrange [{5}:{6}]\nset xtics 10\n"
      "set xlabel 'material angle of the tooth from the major axis, φ [°]' offset 0,0.6\n"
      "set ylabel 'z from the diaphragm [mm]' offset 0.5,0\nset cblabel 'initial backlash [µm]'\n"
      "set label 1 'least {7:+.2f} µm at φ = {8:.2f}°, z = {9:.2f} mm{10}; a line every {11:g} µm' at graph "
      "0,1 "
      "offset character 0,0.9 left\n"
      "set contour base\nset cntrparam levels incremental {12},{11},{6}\nunset clabel\n"
      "set for [i=1:40] linetype i linecolor '#ffffff' linewidth 0.8\nset pm3d map interpolate 2,2\n"
      "splot '{13}.dat' index 0 using 1:2:3 with pm3d nocontour, '' index 0 using 1:2:3 with lines "
      "nosurface, "
      "'' index 1 using 1:2:(0) with points pointtype 6 pointsize 0.9 linewidth 2 linecolor '#D55E00' "
      "nocontour\n",
      falling, number(lo), number(hi), number(b.z_mm.front()), number(b.z_mm.back()), number(b.min_um),
      number(top), b.min_um, b.min_phi_deg, b.min_z_mm, b.interference ? " (interference)" : "", step,
      number(first), figure.name);
  return figure;
}

} // namespace

std::vector<Figure> flank_figures(const ForwardResult& result, const Gear& gear) {
  std::vector<Figure> figures;
  if (result.backlash && result.backlash->assembled && std::isfinite(result.backlash->assembled->min_um))
    figures.push_back(backlash_map(result, *result.backlash->assembled));
  std::vector<const LoadResult*> loads;
  for (const LoadResult& load : result.load) {
    if (load.engaged_count > 0 && !load.points.tooth.empty())
      loads.push_back(&load);
  }
  if (loads.empty())
    return figures;
  std::stable_sort(loads.begin(), loads.end(),
                   [](const LoadResult* a, const LoadResult* b) { return a->torque_nm > b->torque_nm; });
  const LoadResult& largest = *loads.front();
  loads.resize(std::min(loads.size(), most_panels));
  std::reverse(loads.begin(), loads.end());
  const Face face(gear);
  figures.push_back(map_figure("force-map", result, loads, face, Shown::line_load, "line load", "N/mm"));
  figures.push_back(map_figure("gap-map", result, loads, face, Shown::gap, "least gap under load", "µm"));
  figures.push_back(
      map_figure("pressure-map", result, loads, face, Shown::pressure, "contact pressure", "MPa"));
  figures.push_back(tooth_figure(result, largest, gear, face));
  return figures;
}

} // namespace strainwave
