#pragma once
// The default for landscapes with many valleys (the largest meshing force has one per tooth that comes to
// carry load):
//
//     survey: DIRECT-L, ISRES and points spread evenly, side by side      → the best points that lie apart
//     polish: from each of them Ipopt's epigraph, a simplex, gradient sampling   → the best of all
//
// Shares of the budget are fixed beforehand and every part runs on its own, so the result does not depend on
// the number of threads.

#include "strainwave/optimize/plans/optimise.hpp"

namespace strainwave {

/// Uses at most settings.search.budget points. `starts`: how many valleys are polished.
SearchResult global_then_polish(const Problem& problem, const OptimiseSettings& settings, Monitor& monitor);

/// The second half alone: down from every point of `from`, side by side.
SearchResult polish_all(const Problem& problem, const std::vector<SearchPoint>& from,
                        const OptimiseSettings& settings, std::size_t budget, Monitor& monitor);

/// The best of `points` that keep `separation` (share of the ranges, in the largest coordinate) from each
/// other; at most `count`.
std::vector<SearchPoint> best_apart(const Problem& problem, std::vector<SearchPoint> points,
                                    std::size_t count, double separation);

} // namespace strainwave
