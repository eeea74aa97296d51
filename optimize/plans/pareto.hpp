#pragma once
// What does less of one cost in the other: a front of designs between two aims, by the epsilon-constraint
// method (Y. Haimes, L. Lasdon, D. Wismer, IEEE Trans. SMC 1, 1971). The ends are the two optima; between
// them
//
//     minimise f   subject to   second ≤ ε_j   and all limits,      ε_j evenly between the ends.
//
// Every step begins with the best designs that all steps before it have met and that keep its ε. Unlike a
// weighted sum this finds fronts that are hollow.

#include "strainwave/optimize/plans/optimise.hpp"

namespace strainwave {

struct ParetoSettings {
  OptimiseSettings each;  ///< budget: of all points of the front together
  std::size_t points = 7; ///< ends included, at least 2
};

struct ParetoPoint {
  std::optional<double>
      bound; ///< ε in the unit of the second response; nothing at the end where f alone counts
  Judgement judgement;
};

/// `second` is made small too, or large. From the best f to the best second; infeasible ends make an empty
/// front but for the first point, whose verdict says why. `problem`'s evaluator should be a store: points are
/// asked for again.
std::vector<ParetoPoint> pareto_front(const Problem& problem, const Objective& second,
                                      const ParetoSettings& settings, Evaluator& fresh, Monitor& monitor);

} // namespace strainwave
