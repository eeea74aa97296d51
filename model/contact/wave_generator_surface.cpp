#include "model/contact/wave_generator_surface.hpp"

#include <cmath>
#include <utility>

namespace strainwave {

WaveGeneratorSurface::WaveGeneratorSurface(Discs discs, double inner_radius_mm, double half_thickness_mm)
    : discs_(discs), inner_radius_(inner_radius_mm), half_thickness_(half_thickness_mm) {}

WaveGeneratorSurface::WaveGeneratorSurface(Cam cam, double inner_radius_mm, double half_thickness_mm)
    : cam_(std::move(cam)), inner_radius_(inner_radius_mm), half_thickness_(half_thickness_mm) {}

WallGap WaveGeneratorSurface::gap(double phi_rad, double z_mm, double w_mm, double v_mm) const {
  return cam_ ? cam_gap(phi_rad, w_mm, v_mm) : disc_gap(phi_rad, z_mm, w_mm, v_mm);
}

WallGap WaveGeneratorSurface::disc_gap(double phi, double z, double w, double v) const {
  const double radius =
      discs_.neutral_disc_radius_mm - half_thickness_ - discs_.taper_per_mm * (z - discs_.middle_z_mm);
  const double c = std::cos(phi);
  const double s = std::sin(phi);
  const double side = c >= 0.0 ? 1.0 : -1.0; // the disc of this half
  const double e = side * discs_.eccentricity_mm;
  if (discs_.linearised) {
    const double reach = radius + half_thickness_;
    const double neutral = inner_radius_ + half_thickness_;
    return {.gap_mm = w - (e * c + std::sqrt(reach * reach - e * e * s * s) - neutral), .radial = 1.0,
            .circumferential = 0.0};
  }
  // In the frame (e_r, e_φ) of the material angle: point (r + w, v), disc centre (e cos φ, −e sin φ).
  const double along = inner_radius_ + w - e * c;
  const double across = v + e * s;
  const double distance = std::hypot(along, across);
  return {.gap_mm = distance - radius, .radial = along / distance, .circumferential = across / distance};
}

WallGap WaveGeneratorSurface::cam_gap(double phi, double w, double v) const {
  const double radius = std::hypot(inner_radius_ + w, v);
  const double polar = phi + std::atan2(v, inner_radius_ + w);
  // Foot of the perpendicular on the neutral curve: minimise ½|P − C(t)|², C = ρ(t)(cos t, sin t), by Newton from t = polar.
  double t = polar;
  double along = 0.0;
  double across = 0.0;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Curve curve = cam_(t);
    const double c = std::cos(polar - t);
    const double s = std::sin(polar - t);
    // In the frame of t: P = radius (c, s), C = (ρ, 0), C′ = (ρ′, ρ), C″ = (ρ″ − ρ, 2ρ′).
    along = radius * c - curve.rho;
    across = radius * s;
    const double slope = along * curve.first + across * curve.rho;
    const double curvature = curve.first * curve.first + curve.rho * curve.rho -
                             along * (curve.second - curve.rho) - across * 2.0 * curve.first;
    const double step = slope / curvature;
    t += step;
    if (std::abs(step) < 1e-15) break;
  }
  const Curve curve = cam_(t);
  const double c = std::cos(polar - t);
  const double s = std::sin(polar - t);
  along = radius * c - curve.rho;
  across = radius * s;
  // Outward normal of the curve in the frame of t is (ρ, −ρ′)/|C′|; the wall lies inside the neutral curve by t/2.
  const double length = std::hypot(curve.rho, curve.first);
  const double nx = curve.rho / length;
  const double ny = -curve.first / length;
  const double signed_distance = along * nx + across * ny;
  const double turn = t - phi; // from the frame of φ to the frame of t
  return {.gap_mm = signed_distance + half_thickness_,
          .radial = nx * std::cos(turn) - ny * std::sin(turn),
          .circumferential = nx * std::sin(turn) + ny * std::cos(turn)};
}

} // namespace strainwave
