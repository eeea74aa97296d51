#pragma once
// Curvature of the flanks as they are, modification included: what a line contact's width hangs on.
//
// With the roll angle t, w = sigma - t and m(t) the removal along the normal (upper sign: flexspline, lower:
// circular spline) a flank is
//     P = exp(i w) (r_b + i l),   l = r_b t -+ m,      P' = exp(i w) (l -+ i m'),
//     P'' = exp(i w) ((r_b -+ 2 m') - i (l +- m''))
//     curvature = (l^2 +- (l m'' - r_b m') + 2 m'^2) / (l^2 + m'^2)^(3/2)
// which is 1/l, the involute's, where nothing is removed. The flexspline's flank is convex, the circular
// spline's concave: the curvature of their contact is the difference. m'' is taken as the slope of m' over
// 0.4 % of the flank; where the modification has a break there (the start of a relief, a knot) only the side
// on which the point lies counts.

#include "strainwave/model/tooth/backlash.hpp"
#include "strainwave/model/tooth/flank_modification.hpp"

namespace strainwave {

/// 1/mm, of the flexspline's flank (convex above 0) at the point that stood at this radius before the
/// removal.
double flexspline_curvature(const FlankPair&, double radius_mm);

/// 1/mm, of the circular spline's flank (concave above 0) at its point of this distance from the axis.
double circular_spline_curvature(const FlankPair&, double radius_mm);

/// Length along the flexspline's involute from its base circle to a radius: (r^2 - r_b^2)/(2 r_b), mm.
double flank_length_mm(const FlankPair&, double radius_mm);

} // namespace strainwave
