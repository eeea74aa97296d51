#include "app/result_table.hpp"

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/results/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace strainwave::app {

namespace {

constexpr double arcmin_per_rad = 180.0 * 60.0 / std::numbers::pi;

using Out = std::back_insert_iterator<std::string>;

void wave_generator(const WaveGeneratorResult& wg, Out out) {
  fmt::format_to(out, "Wave generator  {}", wg.shape);
  if (wg.wrap_angle_deg > 0.0) {
    fmt::format_to(
        out, ", disc radius {:.4f} mm (to the neutral line), eccentricity {:.4f} mm, wrap angle {:.3f}°",
        wg.disc_radius_mm, wg.eccentricity_mm, wg.wrap_angle_deg);
  }
  fmt::format_to(out, ", u(90°) {:.4f} mm\n", wg.u90_mm);
}

void backlash(const BacklashResult& b, Out out) {
  const auto reach =
      std::count_if(b.backlash_um.begin(), b.backlash_um.end(), [](double c) { return std::isfinite(c); });
  fmt::format_to(
      out, "Backlash        least {:+.3f} µm at φ = {:.3f}°; {} of {} teeth reach the circular spline{}\n",
      b.min_um, b.min_phi_deg, reach, b.tooth.size(),
      b.interference && !b.assembled ? "; INTERFERENCE: flanks overlap before any load" : "");
  if (const auto& a = b.assembled) {
    fmt::format_to(
        out,
        "  … assembled   least {:+.3f} µm at φ = {:.3f}°, z = {:.2f} mm over the face of the coned cup{}\n",
        a->min_um, a->min_phi_deg, a->min_z_mm,
        a->interference ? "; INTERFERENCE: flanks overlap before any load" : "");
  }
}

void backlash_table(const BacklashResult& b, Out out) {
  fmt::format_to(out, "\n  {:>5} {:>9} {:>13} {:>13} {:>16}\n  {:>5} {:>9} {:>13} {:>13} {:>16}\n", "tooth",
                 "φ", "drive", "coast", "contact radius", "", "°", "µm", "µm", "mm");
  for (std::size_t i = 0; i < b.tooth.size(); ++i) {
    if (!std::isfinite(b.backlash_um[i]) && !std::isfinite(b.coast_backlash_um[i]))
      continue;
    const auto cell = [](double x) { return std::isfinite(x) ? fmt::format("{:.3f}", x) : std::string("–"); };
    fmt::format_to(out, "  {:>5} {:>9.3f} {:>12} {:>12} {:>15}\n", b.tooth[i], b.phi_deg[i],
                   cell(b.backlash_um[i]), cell(b.coast_backlash_um[i]), cell(b.contact_radius_mm[i]));
  }
}

void loads(const std::vector<LoadResult>& results, Out out) {
  fmt::format_to(out, "\n  {:>9} {:>10} {:>10} {:>8} {:>8} {:>20} {:>11} {:>9}\n", "torque", "rotation",
                 "peak force", "at φ", "engaged", "from … to φ", "tangent", "disc");
  fmt::format_to(out, "  {:>9} {:>10} {:>10} {:>8} {:>8} {:>20} {:>11} {:>9}\n", "N·m", "mrad", "N", "°",
                 "teeth", "°", "N·m/rad", "N");
  for (const LoadResult& load : results) {
    fmt::format_to(out, "  {:>8.3f} {:>10.4f} {:>10.2f} ", load.torque_nm, 1e3 * load.rotation_rad,
                   load.peak_force_n);
    if (load.engaged_count > 0) {
      fmt::format_to(out, "{:>7.2f} {:>8} {:>20}", load.peak_phi_deg, load.engaged_count,
                     fmt::format("{:.2f} … {:.2f}", load.engaged_lo_deg, load.engaged_hi_deg));
    } else {
      fmt::format_to(out, "{:>7} {:>8} {:>20}", "–", 0, "no contact");
    }
    fmt::format_to(out, " {:>10.1f} ", load.tangent_stiffness_nm_per_rad);
    if (load.disc_force_n > 0.0)
      fmt::format_to(out, "{:>9.2f}", load.disc_force_n);
    else
      fmt::format_to(out, "{:>9}", "–");
    if (load.direction == Direction::coast)
      fmt::format_to(out, "  coast");
    if (!load.coast.tooth.empty())
      fmt::format_to(out, "  coast flanks up to {:.2f} N", load.coast.peak_force_n);
    if (load.transmission_error_arcsec) {
      fmt::format_to(out, "  transmission error {:.3f}″ peak to peak", *load.transmission_error_arcsec);
    }
    fmt::format_to(out, "\n");
  }
  fmt::format_to(out, "\n");
  for (const LoadResult& load : results) {
    const PressurePeak& p = load.peak_pressure;
    if (p.mpa > 0.0)
      fmt::format_to(out,
                     "Pressure        {:.0f} MPa at {:.3f} N·m{}: φ = {:.2f}°, radius {:.3f} mm of the "
                     "flank, z = {:.2f} mm{}\n",
                     p.mpa, load.torque_nm, load.direction == Direction::coast ? " (coast)" : "", p.phi_deg,
                     p.flank_radius_mm, p.z_mm,
                     p.edge ? fmt::format("; a tip edge: at least that (flank on flank: {:.0f} MPa)",
                                          load.peak_flank_pressure.mpa)
                            : std::string());
  }
}

void tooth_forces(const LoadResult& load, Out out) {
  if (load.engaged_count == 0)
    return;
  fmt::format_to(out, "\nMeshing forces at {:.3f} N·m (each of both lobes)\n", load.torque_nm);
  for (std::size_t i = 0; i < load.tooth.size(); ++i) {
    const bool near_zone =
        load.phi_deg[i] >= load.engaged_lo_deg - 6.0 && load.phi_deg[i] <= load.engaged_hi_deg + 6.0;
    if (!near_zone)
      continue;
    const auto bar = static_cast<std::size_t>(std::lround(40.0 * load.force_n[i] / load.peak_force_n));
    if (load.force_n[i] > 0.0) {
      fmt::format_to(out, "  {:>7.2f}° {:>8.2f} N {:>6.0f} MPa  {}\n", load.phi_deg[i], load.force_n[i],
                     load.pressure_mpa[i], std::string(bar, '#'));
    } else {
      fmt::format_to(out, "  {:>7.2f}° {:>8}               gap {:.2f} µm\n", load.phi_deg[i], "–",
                     load.loaded_backlash_um[i]);
    }
  }
}

void certificate(const Certificate& c, Out out) {
  fmt::format_to(out,
                 "Certificate     {}: complementarity {:.1e}, least gap {:.1e} µm, least force {:.1e} N, "
                 "reciprocity {:.1e},\n"
                 "                equilibrium {:.1e}, exact disc gap within {:.1e} µm",
                 c.holds() ? "holds" : "DOES NOT HOLD", c.complementarity, c.min_gap_um, c.min_force_n,
                 c.reciprocity, c.equilibrium, c.exact_gap_residual_um);
  if (c.discretisation_estimate > 0.0) {
    fmt::format_to(out, ", mesh error of the tooth compliance about {:.1f} %",
                   100.0 * c.discretisation_estimate);
  }
  fmt::format_to(out, "\n");
}

} // namespace

std::string result_table(const ForwardResult& result) {
  std::string text;
  const Out out(text);
  fmt::format_to(out, "{} · fidelity {}\n\n", result.gear, choice_name(result.fidelity));
  if (result.wave_generator)
    wave_generator(*result.wave_generator, out);
  if (result.backlash) {
    backlash(*result.backlash, out);
    if (!result.assembly)
      backlash_table(*result.backlash, out);
  }
  if (const auto& a = result.assembly) {
    fmt::format_to(out,
                   "Assembly        {:.2f} N on each disc, wall in contact from {:.2f}° to {:.2f}°, {:.4f} "
                   "mm at the major axis, mid face\n",
                   a->contact_force_n, a->contact_lo_deg, a->contact_hi_deg, a->radial_deformation_mm);
  }
  if (const auto& c = result.compliance; c && result.load.empty()) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (std::size_t i = 0; i < c->tooth.size(); ++i) {
      least = std::min(least, c->matrix_um_per_n[i][i]);
      most = std::max(most, c->matrix_um_per_n[i][i]);
    }
    fmt::format_to(out,
                   "Compliance      {} teeth, own compliance {:.4f} … {:.4f} µm/N (both lobes loaded); the "
                   "matrix is in --json\n",
                   c->tooth.size(), least, most);
  }
  if (!result.load.empty())
    loads(result.load, out);
  if (!result.load.empty())
    tooth_forces(result.load.back(), out);
  if (const auto& s = result.stiffness) {
    fmt::format_to(out,
                   "\nStiffness       {:.1f} N·m/rad (secant at rated torque), wind-up {:.3f}′, take-up "
                   "{:.3f}′, lost motion {:.3f}′\n",
                   s->secant_nm_per_rad, arcmin_per_rad * s->wind_up_rad, arcmin_per_rad * s->take_up_rad,
                   s->lost_motion_arcmin);
  }
  if (const auto& w = result.wedge) {
    fmt::format_to(out,
                   "WEDGED          at rest up to {:.2f} N on a flank, {:.2f} N in all (each lobe; {} drive "
                   "and {} coast "
                   "flanks), rigid overlap {:.2f} µm\n",
                   w->peak_force_n, w->sum_force_n, w->drive_count, w->coast_count, w->overlap_um);
  }
  if (result.certificate && !result.load.empty())
    certificate(*result.certificate, out);
  fmt::format_to(out, "Stages         ");
  for (const Stage& stage : result.stages) {
    if (stage.status == StageStatus::skipped)
      fmt::format_to(out, " {} skipped;", stage.name);
    else
      fmt::format_to(out, " {} {:.1f} ms{};", stage.name, 1e3 * stage.seconds,
                     stage.status == StageStatus::reused ? " reused" : "");
  }
  if (!result.stages.empty())
    text.back() = '\n';
  else
    fmt::format_to(out, " none\n");
  if (!result.message.empty())
    fmt::format_to(out, "\n{}: {}\n", status_name(result.status), result.message);
  return text;
}

std::string path_table(const LoadPath& path) {
  std::string text;
  const Out out(text);
  int point_events = 0, wall_events = 0;
  fmt::format_to(
      out,
      "Load path       phase {:g}, drive, wall gaps linearised about the assembled cup; straight between "
      "events\n\n",
      path.phase);
  fmt::format_to(out, "  {:>10} {:>10} {:>11}  {}\n  {:>10} {:>10} {:>11}\n", "rotation", "torque",
                 "stiffness", "teeth (from here on)", "mrad", "N·m", "N·m/rad");
  const auto line = [&](double rotation_rad, double torque_nm, double stiffness, const std::string& words) {
    fmt::format_to(out, "  {:>10.5f} {:>9.4f} {:>11.1f}  {}\n", 1e3 * rotation_rad, torque_nm, stiffness,
                   words);
  };
  line(path.start_rotation_rad, path.start_torque_nm, path.start_stiffness_nm_per_rad,
       path.carries_at_start.empty()
           ? std::string("rest, no tooth carries")
           : fmt::format("rest, {} points of drive and coast flanks carry", path.carries_at_start.size()));
  for (const LoadPathEvent& event : path.events) {
    std::string words;
    for (const LoadPathChange& change : event.changes)
      if (change.whole_tooth)
        words += fmt::format("{}tooth {} at {:.2f}°{} {}", words.empty() ? "" : ", ", change.point.tooth,
                             change.point.phi_deg, change.point.coast ? " (coast flank)" : "",
                             change.joins ? "joins" : "leaves");
    if (!words.empty())
      line(event.rotation_rad, event.torque_nm, event.stiffness_nm_per_rad, words);
    else
      ++(event.changes.empty() ? wall_events : point_events);
  }
  line(path.end_rotation_rad, path.end_torque_nm,
       path.events.empty() ? path.start_stiffness_nm_per_rad : path.events.back().stiffness_nm_per_rad,
       "end");
  fmt::format_to(out,
                 "\n  {} events in all; not shown: {} of further points of a tooth, {} of the wall alone\n",
                 path.events.size(), point_events, wall_events);
  for (const LoadOnPath& load : path.loads) {
    fmt::format_to(out, "  at {:.4g} N·m, {:.5f} mrad: the direct solution differs by {:.1e} of it",
                   load.torque_nm, 1e3 * load.rotation_rad, load.direct_difference);
    if (load.exact_minus_path_rad)
      fmt::format_to(out, "; the exact disc gap turns it by {:+.2e} mrad", 1e3 * *load.exact_minus_path_rad);
    if (load.exact_minus_path_nm)
      fmt::format_to(out, "; the exact disc gap changes it by {:+.2e} N·m", *load.exact_minus_path_nm);
    fmt::format_to(out, "\n");
  }
  return text;
}

} // namespace strainwave::app
