#pragma once
// Figures of contact over the whole flank, as maps with a scale of colours:
//   force-map      line load of every tooth and slice (N for each mm of the face), one panel for each load
//   gap-map        least gap over the heights that is left under load
//   pressure-map   largest contact pressure over the heights
//   tooth-flank    force and pressure over height and face of the tooth that carries most, at the largest
//   load backlash-map   initial backlash over φ and face of the assembled cup (gaps = "assembled")
// Every map is drawn as the rectangles that its numbers stand for: a tooth's pitch times a slice's share of
// the face.

#include "strainwave/model/export/figure.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/results/result.hpp"

#include <vector>

namespace strainwave {

/// The maps that the result has numbers for: none with one point a tooth and kinematic gaps. The largest four
/// loads are drawn.
std::vector<Figure> flank_figures(const ForwardResult& result, const Gear& gear);

} // namespace strainwave
