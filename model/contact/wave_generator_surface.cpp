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
    return {.gap_mm = w - (e * c + std::sqrt(reach * reach - e * e * s * s) - neutral),
            .radial = 1.0,
            .circumferential = 0.0};
  }
  // In the frame (e_r, e_φ) of the material angle: point (r + w, v), disc centre (e cos φ, −e sin φ).
  const double along = inner_radius_ + w - e * c;
  const double across = v + e * s;
  const double distance = std::hypot(along, across);
  return {.gap_mm = distance - radius, .radial = along / distance, .circumferential = across / distance};
}

WallGap WaveGeneratorSurface::cam_gap(double phi, double w, double v) const {
  const double c = std::cos(phi);
  const double s = std::sin(phi);
  const Foot foot = cam_((inner_radius_ + w) * c - v * s, (inner_radius_ + w) * s + v * c);
  return {.gap_mm = foot.distance_mm + half_thickness_,
          .radial = std::cos(foot.normal_angle_rad - phi),
          .circumferential = std::sin(foot.normal_angle_rad - phi)};
}

} // namespace strainwave
