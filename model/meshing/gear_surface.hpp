#pragma once
// The rigid surface under the wall of this gear, and where along the axis the wall may touch it.

#include "strainwave/model/contact/wave_generator_surface.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"

#include <vector>

namespace strainwave {

/// Rows across the discs where the wall may touch: both edges, which carry nearly all of the force, and the
/// middle. Rows much closer than those of the mesh say the same thing three times, and their compliance is
/// singular to rounding like (width / row spacing)⁴: narrow discs have the middle alone.
std::vector<double> contact_rows(const Gear& gear);

/// The rigid surface that holds the wall; both discs are moved outwards by disc_shift_mm.
WaveGeneratorSurface surface_of(const Gear& gear, const NeutralCurve& curve, double disc_shift_mm = 0.0);

/// Two discs of this gear with these numbers: eccentricity and radius to the neutral line.
WaveGeneratorSurface discs_of(const Gear& gear, double eccentricity_mm, double neutral_disc_radius_mm);

} // namespace strainwave
