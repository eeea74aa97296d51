#pragma once
// Does a gear contradict itself? Checks that need the gear's numbers only: no curve, no finite elements.
// Involute geometry: base radius r_b = (m z/2) cos alpha, half tooth (space) angle at radius rho
//     (pi/2 + 2 x tan alpha)/z + inv alpha - inv(arccos(r_b/rho)),   inv a = tan a - a.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/gear/gear.hpp"

#include <optional>

namespace strainwave {

/// Numbers that reports want beside the verdict; meaningful for a gear without contradiction.
struct ToothThickness {
  double flexspline_tip_mm = 0.0;      ///< arc thickness of the flexspline tooth at its tip circle
  double circular_spline_tip_mm = 0.0; ///< arc thickness of the circular-spline tooth at its tip circle
};
ToothThickness tooth_thickness(const Gear&);

/// The teeth and their modification alone: what the backlash needs.
std::optional<Failure> find_flank_contradiction(const Gear&);

/// The whole gear: teeth, modification, rim, cup, discs.
std::optional<Failure> find_contradiction(const Gear&);

} // namespace strainwave
