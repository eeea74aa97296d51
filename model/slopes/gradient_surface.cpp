#include "strainwave/model/slopes/gradient_surface.hpp"

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/meshing/gear_surface.hpp"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

const std::string u0_path = "wave_generator.max_radial_deformation_mm";
const std::string e_path = "wave_generator.eccentricity_mm";
const std::string wrap_path = "wave_generator.wrap_angle_deg";
const std::string taper_path = "wave_generator.disc_taper_um";

bool has_discs(const Gear& gear) {
  return gear.wave_generator.shape == WaveGeneratorShape::two_disc ||
         gear.wave_generator.shape == WaveGeneratorShape::two_disc_exact;
}

double step_of(double value) {
  return 1e-4 * std::max(1.0, std::abs(value));
}

/// d e/d number where the wrap angle is given instead of e.
double eccentricity_slope(const Gear& gear, const std::string& path) {
  const NumberPath number(path);
  const double value = number.get(gear), h = path == u0_path ? 1e-3 * value : step_of(value);
  const auto eccentricity = [&](double x) {
    Gear moved = gear;
    number.set(moved, x);
    const auto curve = NeutralCurve::make(moved.wave_generator, moved.flexspline);
    return curve ? *curve->summary().eccentricity_mm : std::nan("");
  };
  const double wide = (eccentricity(value + h) - eccentricity(value - h)) / (2.0 * h);
  const double narrow = (eccentricity(value + 0.5 * h) - eccentricity(value - 0.5 * h)) / h;
  return (4.0 * narrow - wide) / 3.0;
}

} // namespace

bool is_surface_parameter(const Gear& gear, const std::string& path) {
  const WaveGenerator& wg = gear.wave_generator;
  if (path == u0_path)
    return wg.shape != WaveGeneratorShape::table && wg.shape != WaveGeneratorShape::four_force;
  if (path == taper_path)
    return has_discs(gear);
  if (path == e_path)
    return has_discs(gear) && wg.eccentricity_mm && !wg.wrap_angle_deg;
  if (path == wrap_path)
    return has_discs(gear) && wg.wrap_angle_deg && !wg.eccentricity_mm;
  return false;
}

SurfaceSlopes::SurfaceSlopes(const Gear& gear, const NeutralCurve& curve, const WaveGeneratorSurface& surface,
                             std::span<const std::string> parameters, double disc_shift_mm)
    : surface_(surface) {
  const bool given = gear.wave_generator.eccentricity_mm.has_value();
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const std::string& path = parameters[j];
    if (!is_surface_parameter(gear, path))
      continue;
    Disc disc; // R = r_m + u0 − e
    Moved moved;
    if (!has_discs(gear)) {
      const NumberPath number(path);
      const double value = number.get(gear);
      moved.step = 1e-3 * value;
      for (const double steps : {-2.0, -1.0, 1.0, 2.0}) {
        Gear other = gear;
        number.set(other, value + steps * moved.step);
        const auto made = NeutralCurve::make(other.wave_generator, other.flexspline);
        moved.surface.push_back(surface_of(other, made ? *made : curve, disc_shift_mm));
      }
    } else if (path == taper_path) {
      disc.taper = 1e-3 / gear.wave_generator.contact_width_mm;
    } else {
      disc.eccentricity = path == e_path ? 1.0 : given ? 0.0 : eccentricity_slope(gear, path);
      disc.radius = (path == u0_path ? 1.0 : 0.0) - disc.eccentricity;
    }
    parameter_.push_back(static_cast<Eigen::Index>(j));
    disc_.push_back(disc);
    if (!has_discs(gear))
      cam_.push_back(std::move(moved));
  }
  disc_.push_back({.eccentricity = 1.0, .radius = 0.0, .taper = 0.0});
}

SurfaceSlopes::Change SurfaceSlopes::at(Eigen::Index column, double phi_rad, double z_mm, double w_mm,
                                        double v_mm) const {
  Change change = alone(column, phi_rad, z_mm, w_mm, v_mm);
  if (const auto k = static_cast<std::size_t>(column); k < shift_.size() && shift_[k] != 0.0) {
    const Change shifted = alone(columns() - 1, phi_rad, z_mm, w_mm, v_mm);
    change.gap += shift_[k] * shifted.gap;
    change.turn += shift_[k] * shifted.turn;
  }
  return change;
}

SurfaceSlopes::Change SurfaceSlopes::alone(Eigen::Index column, double phi_rad, double z_mm, double w_mm,
                                           double v_mm) const {
  const auto k = static_cast<std::size_t>(column);
  if (k < cam_.size()) {
    const Moved& moved = cam_[k];
    const WallGap here = surface_.gap(phi_rad, z_mm, w_mm, v_mm);
    Change side[4];
    for (std::size_t i = 0; i < 4; ++i) {
      const WallGap there = moved.surface[i].gap(phi_rad, z_mm, w_mm, v_mm);
      side[i] = {there.gap_mm,
                 std::atan2(here.radial * there.circumferential - here.circumferential * there.radial,
                            here.radial * there.radial + here.circumferential * there.circumferential)};
    }
    const auto slope = [&](double lo2, double lo1, double hi1, double hi2) {
      return (8.0 * (hi1 - lo1) - (hi2 - lo2)) / (12.0 * moved.step);
    };
    return {slope(side[0].gap, side[1].gap, side[2].gap, side[3].gap),
            slope(side[0].turn, side[1].turn, side[2].turn, side[3].turn)};
  }
  const Disc& disc = disc_[k];
  const WaveGeneratorSurface::DiscSlopes by = surface_.disc_slopes(phi_rad, z_mm, w_mm, v_mm);
  return {by.gap_by_eccentricity * disc.eccentricity + by.gap_by_radius * disc.radius +
              by.gap_by_taper * disc.taper,
          by.turn_by_eccentricity * disc.eccentricity};
}

} // namespace strainwave
