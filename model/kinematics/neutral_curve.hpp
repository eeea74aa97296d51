#pragma once
// The neutral line of the flexspline as the wave generator holds it, and where a tooth goes on it.
//
// Polar angles count counter-clockwise from the major axis of the wave generator; the curve is even and
// repeats after pi. The material point of angle phi (undeformed) moves to radius rho and polar angle phi1,
// and its tooth stands on the outward normal, turned from the radius by theta_n.
//
// two_disc_exact: the inextensible elastica on two rigid discs (elastica.cpp).
// First order (two_disc, four_force, ellipse, cosine, table), with rho = r_m + u(phi1):
//     r_m phi = int_0^phi1 sqrt(rho^2 + rho'^2)        theta_n = -arctan(rho'/rho)
// counted from the nearer end of the major axis and never rescaled: at phi = +-90 degrees, where such a curve
// does not close, phi1 differs from phi.
//
// Seed gear, exact discs, phi = 30 degrees:
//     phi1 - phi = -6.412312252e-3    rho - r_m = 0.118293683 mm    theta_n = 2.180548513e-2
// Lengths in mm, angles in rad. Exact to rounding; a pose costs 0.04 (exact) to 0.2 microseconds.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/gear/gear.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string_view>

namespace strainwave {

/// Where a material point of the neutral line stands, and the direction of its tooth: polar angle phi1 +
/// normal_rotation.
struct Pose {
  double rho_mm = 0.0;
  double phi1_rad = 0.0;
  double normal_rotation_rad = 0.0;
};

/// Columns of PoseDerivatives: material angle [rad], neutral radius [mm], u0 [mm], and the shape's own
/// number: eccentricity [mm] or, when that was given instead, wrap angle [rad]; force angle [rad]; nothing
/// (zero column) for the other shapes.
enum PoseVariable : std::size_t {
  by_material_angle,
  by_neutral_radius,
  by_radial_deformation,
  by_shape_number
};

struct PoseDerivatives {
  Pose value;
  std::array<double, 4> rho{}, phi1{}, normal_rotation{};
};

/// Radial displacement of the neutral line at a polar angle, with derivatives with respect to that angle.
struct RadialDisplacement {
  double u_mm = 0.0;
  double first_mm = 0.0;
  double second_mm = 0.0;
};

/// Numbers of a curve that reports want. Those that a shape does not have are absent.
struct CurveSummary {
  double u0_mm = 0.0;                      ///< displacement at the major axis
  double u90_mm = 0.0;                     ///< displacement at the minor axis
  double perimeter_excess_mm = 0.0;        ///< perimeter - 2 pi r_m
  std::optional<double> wrap_angle_rad;    ///< two discs: polar lift-off angle (first order: gamma)
  std::optional<double> lift_off_arc_rad;  ///< two_disc_exact: lift-off arc about the disc's centre
  std::optional<double> n_over_ei_per_mm2; ///< two_disc_exact: axial force over bending stiffness, N/(EI)
  std::optional<double> eccentricity_mm;   ///< two discs
  std::optional<double>
      disc_radius_mm; ///< two discs: r_m + u0 - e, to the neutral line (disc itself: minus half the rim)
};

/// Foot of the perpendicular from a point onto the neutral line; rigid cams hold the wall along a parallel of
/// this line.
struct CurveFoot {
  double distance_mm = 0.0;      ///< along the outward normal; negative inside the curve
  double polar_angle_rad = 0.0;  ///< of the foot
  double normal_angle_rad = 0.0; ///< direction of the outward normal there
};

class CurveShape; // the shapes themselves, neutral_curve.cpp

class NeutralCurve {
public:
  /// Failures: no_wrap, singular_wave_generator, contradiction, not_converged. A bad table file throws
  /// std::runtime_error "file:line: …".
  static Outcome<NeutralCurve> make(const WaveGenerator&, const Flexspline&);

  Pose pose(double material_angle_rad) const;
  PoseDerivatives pose_derivatives(double material_angle_rad) const;
  RadialDisplacement displacement(double polar_angle_rad) const;
  CurveFoot foot(double x_mm, double y_mm) const;

  const CurveSummary& summary() const { return summary_; }
  WaveGeneratorShape shape() const { return shape_; }
  double neutral_radius_mm() const { return neutral_radius_; }
  /// The gear-file path behind by_shape_number ("" when there is none). Angles are there in degrees.
  std::string_view shape_number_path() const { return shape_number_path_; }

private:
  NeutralCurve() = default;
  std::shared_ptr<const CurveShape> curve_;
  CurveSummary summary_;
  WaveGeneratorShape shape_ = WaveGeneratorShape::two_disc;
  double neutral_radius_ = 0.0;
  std::string_view shape_number_path_;
};

} // namespace strainwave
