#pragma once
// The rigid surface on which the inner wall of the flexspline rests, and the gap of a wall point to it.
//
//   two discs   circles of radius R − t/2 about (±e, 0); the exact gap of a displaced wall point (x, y) is
//                   √((x ∓ e)² + y²) − (R − t/2)
//               and its gradient is the unit vector from the disc's centre: force on the wall acts along it.
//   linearised  w − [e cos φ + √(R² − e² sin²φ) − r_m]: radial displacement alone, force radial. For
//   comparison only: it
//               costs 8 µm of shape and a fifth of the assembly force on the seed cup.
//   cam         the neutral curve of an ellipse, cosine or table wave generator, offset inwards by t/2: the
//   exact gap is the
//               signed distance to the neutral curve plus t/2 (a wall at rest on the cam lies t/2 inside the
//               curve).
//
// A conical disc (taper) has R falling linearly along the axis by `taper_mm` over the contact width, R in its
// middle.

#include <functional>

namespace strainwave {

/// Gap of a wall point and its derivative with respect to the point's radial and circumferential
/// displacement.
struct WallGap {
  double gap_mm = 0.0;
  double radial = 1.0;          ///< ∂gap/∂w = radial component of the contact normal
  double circumferential = 0.0; ///< ∂gap/∂v
};

class WaveGeneratorSurface {
public:
  struct Discs {
    double eccentricity_mm = 0.0;
    double neutral_disc_radius_mm = 0.0; ///< R, to the neutral line
    bool linearised = false;
    double taper_per_mm = 0.0; ///< −dR/dz
    double middle_z_mm = 0.0;  ///< where R holds
  };
  /// A cam: foot of the perpendicular from a point (x, y) onto the neutral curve.
  struct Foot {
    double distance_mm = 0.0;      ///< along the outward normal; negative inside the curve
    double normal_angle_rad = 0.0; ///< direction of that normal
  };
  using Cam = std::function<Foot(double x_mm, double y_mm)>;

  /// inner_radius_mm: of the undeformed wall; half_thickness_mm: from there to the neutral line.
  WaveGeneratorSurface(Discs discs, double inner_radius_mm, double half_thickness_mm);
  WaveGeneratorSurface(Cam cam, double inner_radius_mm, double half_thickness_mm);

  /// Gap at the wall point of material angle φ and axial position z, displaced by w (outwards) and v (towards
  /// larger φ).
  WallGap gap(double phi_rad, double z_mm, double w_mm, double v_mm) const;
  /// Curvature of the surface of equal gap there, 1/mm: a displacement along the tangent turns the normal by
  /// so much.
  double curvature(double phi_rad, double z_mm, double w_mm, double v_mm) const;
  /// Change of gap [mm] and turn of the normal towards the tangent [rad] at a held wall point, per mm of the
  /// discs' eccentricity and neutral radius and per unit of taper_per_mm. Zero for cams.
  struct DiscSlopes {
    double gap_by_eccentricity = 0.0, turn_by_eccentricity = 0.0;
    double gap_by_radius = 0.0, gap_by_taper = 0.0;
  };
  DiscSlopes disc_slopes(double phi_rad, double z_mm, double w_mm, double v_mm) const;
  double inner_radius_mm() const { return inner_radius_; } ///< of the undeformed wall

private:
  WallGap disc_gap(double phi, double z, double w, double v) const;
  WallGap cam_gap(double phi, double w, double v) const;

  Discs discs_;
  Cam cam_;
  double inner_radius_;
  double half_thickness_;
};

} // namespace strainwave
