#pragma once
// Outline of a flexspline tooth in a section z = const: half the angle of the tooth at a radius.
//
// Involute through the pitch point, s the roll from there (the project's physics page, section 4):
//   radius² = r1² (1 + 2 s sin α0 cos α0 + s² cos² α0),  r1 = m z1/2
//   angle   = atan2(y, x)
//             x = cos(s − θ) + s cos α0 sin(s − θ + α0)
//             y = −sin(s − θ) + s cos α0 cos(s − θ + α0)
//   θ       = (π/2 + 2 x1 tan α0)/z1, half the tooth's angle on the pitch circle
// Below the base circle r1 cos α0 there is no involute; the flank goes on radially.

#include "strainwave/model/gear/gear.hpp"

namespace strainwave {

/// Half the tooth's angle [rad] at a radius [mm]; negative where the flanks have crossed (a pointed tooth).
double tooth_half_angle(const Flexspline& flexspline, double radius_mm);

} // namespace strainwave
