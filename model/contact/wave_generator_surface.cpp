#include "strainwave/model/contact/wave_generator_surface.hpp"

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

double WaveGeneratorSurface::curvature(double phi_rad, double z_mm, double w_mm, double v_mm) const {
  if (!cam_ && discs_.linearised)
    return 0.0;
  const WallGap at = gap(phi_rad, z_mm, w_mm, v_mm);
  if (!cam_) {
    const double radius =
        discs_.neutral_disc_radius_mm - half_thickness_ - discs_.taper_per_mm * (z_mm - discs_.middle_z_mm);
    return 1.0 / (at.gap_mm + radius);
  }
  // A cam: from the turn of the normal over a step along the tangent; error some h²/r³ and 1e-15 r/h.
  const double h = 1e-3 * inner_radius_;
  const auto turned = [&](double step) {
    const WallGap there = gap(phi_rad, z_mm, w_mm - step * at.circumferential, v_mm + step * at.radial);
    return std::atan2(at.radial * there.circumferential - at.circumferential * there.radial,
                      at.radial * there.radial + at.circumferential * there.circumferential);
  };
  const double once = (turned(h) - turned(-h)) / (2.0 * h),
               twice = (turned(2.0 * h) - turned(-2.0 * h)) / (4.0 * h);
  return (4.0 * once - twice) / 3.0;
}

WaveGeneratorSurface::DiscSlopes WaveGeneratorSurface::disc_slopes(double phi_rad, double z_mm, double w_mm,
                                                                   double v_mm) const {
  if (cam_)
    return {};
  const double c = std::cos(phi_rad), s = std::sin(phi_rad), side = c >= 0.0 ? 1.0 : -1.0;
  const double behind = z_mm - discs_.middle_z_mm;
  if (discs_.linearised) {
    const double reach = discs_.neutral_disc_radius_mm - discs_.taper_per_mm * behind;
    const double e = discs_.eccentricity_mm, root = std::sqrt(reach * reach - e * e * s * s);
    return {.gap_by_eccentricity = e * s * s / root - side * c,
            .turn_by_eccentricity = 0.0,
            .gap_by_radius = -reach / root,
            .gap_by_taper = reach / root * behind};
  }
  const WallGap at = disc_gap(phi_rad, z_mm, w_mm, v_mm);
  const double along = -side * c, across = side * s; // how the wall point moves, seen from the disc's centre
  return {.gap_by_eccentricity = at.radial * along + at.circumferential * across,
          .turn_by_eccentricity =
              (at.radial * across - at.circumferential * along) * curvature(phi_rad, z_mm, w_mm, v_mm),
          .gap_by_radius = -1.0,
          .gap_by_taper = behind};
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
