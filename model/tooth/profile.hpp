#pragma once
// Points along the flanks: for drawings, for export, and for contact at many points of a flank.
//
// Polar points count their angle from the tooth's (space's) centre line towards the drive flank, h runs from
// 0 to 1 (flexspline: root to tip; circular spline: tip to root). The coast flank is the mirror image.

#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/tooth/backlash.hpp"
#include "strainwave/model/tooth/flank_modification.hpp"

#include <optional>
#include <vector>

namespace strainwave {

struct PolarPoint {
  double radius_mm = 0.0;
  double angle_rad = 0.0;
};

/// Drive flank of a member at n >= 2 equidistant flank coordinates, modification included, not deformed.
std::vector<PolarPoint> flank_profile(const FlankPair&, Member, int points);

/// The flexspline's drive flank standing in a pose, in the gear's frame (angle from the major axis).
std::vector<PolarPoint> posed_flank_profile(const FlankPair&, const Pose&, int points);

/// Gap between the flanks at one place, as an arc at the radius of the flexspline's point.
struct GapPoint {
  double flank_height = 0.0; ///< h on the flexspline
  double radius_mm = 0.0;    ///< distance of the point from the gear's axis
  double gap_mm = 0.0;
};

/// Drive gap at flank coordinate h of the flexspline; nothing where the circular spline has no flank at that
/// radius. For the coast gap mirror the arguments: pose {rho, -phi1, -normal_rotation}, space angle
/// -space_angle.
std::optional<GapPoint> gap_at_height(const FlankPair&, const Pose&, double space_angle_rad,
                                      double flank_height);

/// Drive gap at n >= 2 points, equidistant in roll angle over the stretch where both flanks exist, both ends
/// included; empty without such a stretch.
std::vector<GapPoint> gap_profile(const FlankPair&, const Pose&, double space_angle_rad, int points);

} // namespace strainwave
