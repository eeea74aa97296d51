#pragma once
// Our own judgement of an optimum. What a method says of itself is one witness among several:
//
//   converged   a new small search from the best point, by another simplex, and gradient sampling around it
//               (descent.hpp) find nothing better, without a single failed evaluation; a fresh evaluation
//               gives the same numbers and keeps every limit
//   stalled     a feasible point, but one of these witnesses is missing; the sentence says which
//   budget      the evaluations were used up first
//   infeasible  no design was found that keeps all limits; the one that violates them least is reported
//   stopped     ended from outside

#include "strainwave/optimize/methods/search.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace strainwave {

enum class Verdict { converged, stalled, budget, infeasible, stopped };
std::string_view verdict_name(Verdict verdict);

struct Judgement {
  Verdict verdict = Verdict::stalled;
  std::string message;             ///< one sentence
  std::optional<SearchPoint> best; ///< as evaluated fresh
  std::optional<Evaluation> fresh; ///< the reported optimum, evaluated again from nothing
};

/// Small searches from the best point of `found` until one of them improves it by less than
/// `settings.tolerance`, relative. `found` takes over better points and all counts. True: confirmed.
bool confirm(const Problem& problem, SearchResult& found, const SearchSettings& settings, std::size_t budget,
             Monitor& monitor);

/// `fresh` shares no memory with the evaluator that the search used.
Judgement judge(const Problem& problem, const SearchResult& found, bool confirmed, Evaluator& fresh);

} // namespace strainwave
