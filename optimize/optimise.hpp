#pragma once
// A whole optimisation: several searches, the best of them confirmed and judged.
//
//     starts → searches (in parallel) → best → confirmation → verdict
//
// Three quarters of the budget go to the searches, in equal shares; the rest confirms. Each search depends on
// its start and its share alone, and the best is taken in the order of the starts, so the result is the same
// for any number of threads.

#include "optimize/verdict.hpp"

namespace strainwave {

struct OptimiseSettings {
  SearchSettings search; ///< budget: of all searches together
  std::size_t starts = 1;
  int threads = 1; ///< 0: all cores
};

struct OptimiseResult {
  Judgement judgement;
  SearchResult found;
};

/// `fresh`: see judge(). An exception of one search ends them all.
OptimiseResult optimise(const Problem& problem, const OptimiseSettings& settings, Evaluator& fresh,
                        Monitor& monitor);

} // namespace strainwave
