#pragma once
// How backlash and contact radius of every tooth change with the numbers of the gear file.
//
// At its least value the gap is stationary, or its place is an edge that moves with its own parameter: the
// gap is evaluated once, at the place that backlash() found, in numbers that carry derivatives (envelope
// theorem); the contact radius also needs how an inner minimum moves, dt/dp = -(d2 gap/dt dp)/(d2 gap/dt2).
// The search is not repeated. Where two places tie, where slope_um or lead_taper_um is 0 and where a kink is
// met exactly, the derivative is one-sided.
//
// Parameters are named by gear-file path, knots as "flank_modification.flexspline.spline_um[2]" (counted from
// 0); derivatives are per unit of the file's key (mm, degree, um, 1). Each is the change of that key alone:
// flexspline.neutral_radius_mm moves the neutral line, not the root circle.

#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/tooth/backlash.hpp"

#include <span>
#include <string>
#include <vector>

namespace strainwave {

/// Every path that a gradient can be asked for with this gear and curve, in the order of the gear file.
std::vector<std::string> backlash_parameters(const Gear&, const NeutralCurve&);

/// Entry (tooth k, parameter j) of each array stands at k * parameters + j; zero rows where the flanks do not
/// overlap.
struct BacklashGradient {
  std::size_t parameters = 0;
  std::vector<double> drive_mm, drive_radius_mm;
  std::vector<double> coast_mm, coast_radius_mm;
};

/// Derivatives of `at`, a result of backlash(gear, curve, …). A path that is not one of backlash_parameters()
/// throws std::invalid_argument.
BacklashGradient backlash_gradient(const Gear&, const NeutralCurve&, const Backlash& at,
                                   std::span<const std::string> parameters);

} // namespace strainwave
