#pragma once
// From an error to the small rigid motion of a flexspline tooth against its circular-spline space.
//
// Only the motion of one against the other matters; a motion of the space counts backwards for the tooth.
// Components are taken at the tooth's polar angle phi1: radial outwards, tangential and rotation
// counter-clockwise; the tooth is represented by its point of the neutral line.

#include "model/kinematics/neutral_curve.hpp"
#include "studies/tolerance/tolerance_source.hpp"

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

/// `values`: those of this source alone. backlash_noise moves nothing.
ToothMotion error_motion(const ToleranceSource&, std::span<const double> values, const MeshPlace&,
                         const MeshNumbers&);

} // namespace strainwave
