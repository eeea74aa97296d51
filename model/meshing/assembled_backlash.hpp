#pragma once
// Initial backlash of the cup as it stands on the wave generator, over material angle and face: each section
// of each tooth in its pose from the finite-element assembly (flank_points.hpp), against a rigid circular
// spline. What contact with gaps = "assembled" starts from, and where interference of the coned cup shows.
// Drive flank, meshing phase 0; the coast flank is its mirror image φ → −φ.

#include "strainwave/model/meshing/flank_points.hpp"
#include "strainwave/model/results/result.hpp"

#include <span>

namespace strainwave {

/// Places along the axis at which the backlash is taken: equidistant, both ends of the face included.
std::vector<double> backlash_sections(const Flexspline& flexspline, int count = 9);

/// `poses` and `flanks`: one for each of z_mm; `phi_rad`: material angles, ascending. Least over continuous
/// φ: around the least tooth of every section by golden section.
AssembledBacklash assembled_backlash(const AssembledPoses& poses, const std::vector<FlankPair>& flanks,
                                     const std::vector<double>& z_mm, std::span<const double> phi_rad,
                                     double teeth_ratio);

} // namespace strainwave
