#pragma once
// A whole optimisation: searches, the best of them confirmed and judged.
//
//     global_then_polish, or starts → searches side by side     → best → confirmation → verdict
//
// Three quarters of the budget go to the searches; the rest confirms. Each search depends on its start and
// its share alone, and the best is taken in the order of the starts, so the result is the same for any number
// of threads.

#include "strainwave/optimize/plans/verdict.hpp"

namespace strainwave {

/// Survey and polish (global_then_polish.hpp), the default of studies.
inline constexpr std::string_view global_method = "global_then_polish";

/// Everything that SearchSettings::method may be here: global_method, the methods of NLopt, and Ipopt.
std::span<const std::string_view> method_names();

struct OptimiseSettings {
  SearchSettings search;  ///< budget: of all searches together
  std::size_t starts = 1; ///< searches side by side, or valleys to polish
  int threads = 1;        ///< 0: all cores
  std::vector<std::vector<double>> known =
      {}; ///< scaled designs that compete as they are: the unmodified gear
};

struct OptimiseResult {
  Judgement judgement;
  SearchResult found;
};

/// `fresh`: see judge(). An exception of one search ends them all.
OptimiseResult optimise(const Problem& problem, const OptimiseSettings& settings, Evaluator& fresh,
                        Monitor& monitor);

} // namespace strainwave
