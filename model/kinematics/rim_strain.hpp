#pragma once
// Bending strain of the flexspline's rim by the wave generator: a ring of thickness t whose neutral line is
// bent from the curvature 1/r_m to κ has the strain t/2 |κ − 1/r_m| at its surfaces. With ψ = φ1 + θ_n, the
// direction of a tooth, and the material angle φ, ds = r_m dφ:
//
//     κ = dψ/ds = (dφ1/dφ + dθ_n/dφ) / r_m.
//
// Example: u0 cos 2φ to first order, Δκ = 3 u0/r_m²: seed gear (t = 0.3, u0 = 0.2, r_m = 14.006) 4.6e-4. On
// the two discs κ is 1/R. Teeth stiffen the rim and concentrate strain in the tooth spaces; neither is part
// of this number.

#include "strainwave/model/kinematics/neutral_curve.hpp"

namespace strainwave {

/// Largest over the neutral line, looked at every half degree of a quadrant; a plain number.
double rim_strain(const NeutralCurve& curve, double rim_thickness_mm);

} // namespace strainwave
