// PhaseSlopes::pressure. With w the line load, 1/R the relative curvature and s the share of the flank
// (pressure.hpp)
//     Hertz  p = √(w E* / (π R))     dp = p/2 (dw/w + d(1/R) R)
//     mean   p = w / s               dp = p (dw/w − ds/s)
// The curvatures of modified flanks have no derivatives of their own here: d(1/R) is a central difference of
// them, the contact moving along; they are close to linear in every key.

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/meshing/flank_points.hpp"
#include "strainwave/model/meshing/pressure.hpp"
#include "strainwave/model/slopes/gradient_detail.hpp"
#include "strainwave/model/slopes/gradient_phase.hpp"
#include "strainwave/model/tooth/flank_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strainwave {

using namespace slopes;

namespace {

double relative_curvature(const FlankPair& pair, double flank_radius, double contact_radius) {
  return flexspline_curvature(pair, flank_radius) - circular_spline_curvature(pair, contact_radius);
}

/// The flanks with one number of the gear changed; nothing where that is no gear.
std::optional<FlankPair> changed_flanks(const Gear& gear, const std::string& path, double by, double zeta) {
  try {
    Gear other = gear;
    const NumberPath number(path);
    number.set(other, number.get(gear) + by);
    auto pair = FlankPair::make(other, zeta);
    if (pair)
      return std::move(pair).value();
  } catch (const FieldError&) { // out of the key's range
  }
  return std::nullopt;
}

} // namespace

Eigen::VectorXd PhaseSlopes::pressure(const std::vector<LoadedPoint>& points, const PhaseLoad& load,
                                      const Eigen::MatrixXd& force, std::size_t point,
                                      double pressure) const {
  const Gear& gear = in_.gear;
  const LoadedPoint& at = points[point];
  const FlankPair& pair = in_.flanks[static_cast<std::size_t>(std::max(0, at.slice))];
  const PointChange by = change(at);

  // dw/w
  Eigen::VectorXd relative = force.row(static_cast<Eigen::Index>(point)).transpose() / load.force_n[point];
  const double circular_base = 0.5 * gear.flexspline.module_mm * gear.circular_spline.teeth *
                               std::cos(gear.flexspline.pressure_angle_deg * std::numbers::pi / 180.0);
  if (gear.contact.direction_of_force() == ForceDirection::circumferential &&
      at.contact_radius_mm > circular_base)
    relative += by.row(of_radius).transpose() / at.contact_radius_mm;

  // Neighbours over and under it, for the share.
  const LoadedPoint *above = nullptr, *below = nullptr;
  for (const LoadedPoint& other : points) {
    if (other.tooth != at.tooth || other.slice != at.slice)
      continue;
    if (other.flank_radius_mm > at.flank_radius_mm &&
        (!above || other.flank_radius_mm < above->flank_radius_mm))
      above = &other;
    if (other.flank_radius_mm < at.flank_radius_mm &&
        (!below || other.flank_radius_mm > below->flank_radius_mm))
      below = &other;
  }
  const bool alone = !above && !below;
  const LoadedPoint &top = above ? *above : at, &bottom = below ? *below : at;
  const auto length = [&](const LoadedPoint& p) { return flank_length_mm(pair, p.flank_radius_mm); };
  const double share = alone ? flank_length_mm(pair, gear.flexspline.tip_radius_mm) -
                                   flank_length_mm(pair, gear.flexspline.root_radius_mm)
                             : 0.5 * (length(top) - length(bottom));
  const double curvature = relative_curvature(pair, at.flank_radius_mm, at.contact_radius_mm);
  // Which of both it is: Hertz' half width against half the share.
  const double hertz_width =
      2.0 * pressure / (contact_modulus_mpa(gear.material) * std::max(curvature, 1e-300)); // b = 2 p R / E*
  const bool mean = !(curvature > 0.0) || std::numbers::pi * hertz_width > 2.0 * share * (1.0 + 1e-12);
  if (mean) {
    if (alone)
      return pressure * relative;
    const double base = 0.5 * gear.flexspline.module_mm * gear.flexspline.teeth *
                        std::cos(gear.flexspline.pressure_angle_deg * std::numbers::pi / 180.0);
    const Eigen::VectorXd of_share = 0.5 / base *
                                     (top.flank_radius_mm * change(top).row(of_height) -
                                      bottom.flank_radius_mm * change(bottom).row(of_height))
                                         .transpose();
    return pressure * (relative - of_share / share);
  }
  const double zeta = face_coordinate(gear.flexspline, at.z_mm);
  for (Eigen::Index j = 0; j < count_; ++j) {
    const std::string& path = in_.parameters[static_cast<std::size_t>(j)];
    const double step = path.find("_um") != std::string::npos ? 1e-3 : 1e-6;
    const auto moved = [&](double change_by) {
      std::optional<FlankPair> other = pair;
      if (is_flank_parameter(gear, path))
        other = changed_flanks(gear, path, change_by, zeta);
      return other
                 ? std::optional(relative_curvature(*other, at.flank_radius_mm + change_by * by(of_height, j),
                                                    at.contact_radius_mm + change_by * by(of_radius, j)))
                 : std::nullopt;
    };
    const auto more = moved(step), less = moved(-step);
    if (more && less)
      relative(j) += (*more - *less) / (2.0 * step * curvature);
    else if (more)
      relative(j) += (*more - curvature) / (step * curvature);
    else if (less)
      relative(j) += (curvature - *less) / (step * curvature);
  }
  return 0.5 * pressure * relative;
}

} // namespace strainwave
