#pragma once
// Material removed from a flank, along its normal.
//
// Flank coordinate h: flexspline 0 at its root circle, 1 at its tip; circular spline 0 at its tip circle, 1
// at its root; linear in radius. q runs from a member's root to its tip: h, or 1 - h on the circular spline.
// Face coordinate zeta: -1 at the diaphragm's end of the face, 0 mid face, +1 at the open end. The sum of
//     tip relief A       A ((q - start)/(1 - start))^power      for q > start
//     root relief B      B (start - q)/start                    for q < start
//     crowning C         C (2 h - 1)^2
//     slope S            S h  when S > 0,  |S| (1 - h)  when S < 0
//     spline             natural cubic through equidistant values, h = 0 to 1 (one: constant, two: straight)
//     lead crowning L    L zeta^2
//     lead taper K       K (1 + zeta)/2  when K > 0,  |K| (1 - zeta)/2  when K < 0
//     end relief E       E (1 - d/length)^2  at distance d < length from either end of the face
// must not be negative. Derivatives with respect to slope and taper at zero are those towards positive
// values.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/gear/gear.hpp"

#include <optional>

namespace strainwave {

enum class Member { flexspline, circular_spline };

/// Removal [mm] at flank coordinate h and face coordinate zeta. face_width_mm is needed by end relief only.
double removal_mm(const FlankModification&, Member, double h, double zeta, double face_width_mm);

/// The sentence for a modification that would add material somewhere, or whose numbers have no meaning.
std::optional<Failure> find_added_material(const FlankModification&, Member, double face_width_mm);

} // namespace strainwave
