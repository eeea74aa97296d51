#pragma once
// The default for landscapes with many valleys (the largest meshing force has one per tooth that comes to
// carry load):
//
//     survey: DIRECT-L, ISRES and points spread evenly, side by side      → the best points that lie apart
//     polish: from each of them a simplex and gradient sampling (verdict.hpp, descent.hpp)  → the best of all
//
// Shares of the budget are fixed beforehand and every part runs on its own, so the result does not depend on
// the number of threads.

#include "optimize/optimise.hpp"

namespace strainwave {

/// Uses at most settings.search.budget points. `starts`: how many valleys are polished.
SearchResult global_then_polish(const Problem& problem, const OptimiseSettings& settings, Monitor& monitor);

/// The best of `points` that keep `separation` (share of the ranges, in the largest coordinate) from each
/// other; at most `count`.
std::vector<Point> best_apart(const Problem& problem, std::vector<Point> points, std::size_t count,
                              double separation);

} // namespace strainwave
