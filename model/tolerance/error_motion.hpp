#pragma once
// From an error to the small rigid motion of a flexspline tooth against its circular-spline space.
//
// Only the motion of one against the other matters; a motion of the space counts backwards for the tooth.
// Components are taken at the tooth's polar angle phi1: radial outwards, tangential and rotation
// counter-clockwise; the tooth is represented by its point of the neutral line.

#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/tolerance/tolerance_source.hpp"

#include <span>

namespace strainwave {

struct ToothMotion {
  double radial_mm = 0.0;
  double tangential_mm = 0.0;
  double rotation_rad = 0.0;
  ToothMotion& operator+=(const ToothMotion& o) {
    radial_mm += o.radial_mm;
    tangential_mm += o.tangential_mm;
    rotation_rad += o.rotation_rad;
    return *this;
  }
};

/// A tooth in its place of the mesh and which of the teeth of either member stands there.
struct MeshPlace {
  PoseDerivatives pose;         ///< relative to the tooth's own lobe
  double space_angle_rad = 0.0; ///< relative to the lobe
  int flexspline_tooth = 0;     ///< 0 … z1 − 1
  int space = 0;                ///< 0 … z2 − 1
};

struct MeshNumbers {
  int flexspline_teeth = 0, circular_spline_teeth = 0;
  double flexspline_pitch_mm = 0.0, circular_spline_pitch_mm = 0.0; ///< radii r1, r2
  double neutral_radius_mm = 0.0;
};

/// What an error comes down to at one tooth k of its member, in two numbers. Per-tooth errors: delta_k and 0.
/// All others are a vector (p, q) seen in the frame of the tooth, which stands at the angle m theta_k: first
/// = p cos + q sin, second = q cos - p sin. Errors of shape: their size and 0.
struct ErrorAtTooth {
  double first = 0.0;
  double second = 0.0;
};

/// m and (p, q) of a sample of a source that is no per-tooth error: tooth_thickness (ds, 0), m = 0;
/// cumulative_pitch and run_out A (cos psi, sin psi), m = n and 1; centre_offset (x, y), m = 1; ovality A
/// (cos 2 psi, sin 2 psi), m = 2.
bool is_per_tooth(ToleranceKind);
int error_order(const ToleranceSource&);
ErrorAtTooth error_vector(const ToleranceSource&, std::span<const double> values);

/// Errors that are no motion of the whole tooth: backlash_noise and those of the flank's shape.
bool is_of_shape(ToleranceKind);

/// Linear in the error, for the drive flank. backlash_noise and errors of shape move nothing.
ToothMotion error_motion(const ToleranceSource&, const ErrorAtTooth&, const MeshPlace&, const MeshNumbers&);

} // namespace strainwave
