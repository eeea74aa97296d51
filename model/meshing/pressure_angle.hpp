#pragma once
// The local pressure angle α′ of a contact: between the common normal and the circumferential direction at
// the contact point. Where the flexspline's edge touches, the normal is the circular spline's flank normal,
// else the flexspline's. Involute at radius r: cos α = r_b/r. A flexspline tooth moves as a rigid body, so
// its normal turns with it:
//     α′ = arccos(r_b/r) − (φ1 + θ_n + β − φ_c)
// with β the flank point's angle from the tooth's centre line and φ_c the polar angle at which the point now
// stands.

#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/tooth/backlash.hpp"

namespace strainwave {

/// rad. Flank modifications (µm over a flank of some 0.4 mm) turn the normal by less than a degree and are
/// left out.
double contact_pressure_angle(const Gear& gear, const Pose& pose, const ToothBacklash& contact);

} // namespace strainwave
