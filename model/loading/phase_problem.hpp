#pragma once
// The loaded pair at one meshing phase as the LCP that it is, all points at once: for whoever asks what the
// compliance alone allows (bounds), not what one gear does.

#include "strainwave/model/contact/load_problem.hpp"

#include <vector>

namespace strainwave {

/// Drive flanks. Arrays run over the points: teeth × heights × slices.
struct PhaseProblem {
  double phase = 0.0;
  std::vector<LoadedPoint> points;
  LoadProblem load;
};

} // namespace strainwave
