#include "strainwave/optimize/plans/optimise.hpp"

#include "strainwave/common/threads/parallel.hpp"
#include "strainwave/optimize/methods/ipopt_search.hpp"
#include "strainwave/optimize/methods/nlopt_search.hpp"
#include "strainwave/optimize/methods/start_points.hpp"
#include "strainwave/optimize/plans/global_then_polish.hpp"

#include <algorithm>

namespace strainwave {

namespace {

SearchResult multi_start(const Problem& problem, const OptimiseSettings& settings, Monitor& monitor) {
  const std::size_t starts = std::max<std::size_t>(1, settings.starts);
  SearchSettings share = settings.search;
  share.budget = std::max<std::size_t>(1, settings.search.budget / starts);
  const auto points = start_points(problem.design(), starts, settings.search.seed);
  std::vector<SearchResult> results(starts);
  parallel_for(starts, settings.threads, [&](std::size_t k) {
    results[k] = settings.search.method == ipopt_method ? search_ipopt(problem, points[k], share, monitor)
                                                        : search_nlopt(problem, points[k], share, monitor);
  });

  SearchResult found = results.front();
  bool stopped = found.end == SearchEnd::stopped;
  for (std::size_t k = 1; k < starts; ++k) {
    const SearchResult& result = results[k];
    const std::size_t asked = found.asked + result.asked;
    const std::size_t failed = found.failed + result.failed;
    std::vector<SearchPoint> seen = std::move(found.seen);
    seen.insert(seen.end(), result.seen.begin(), result.seen.end());
    if (result.best && (!found.best || better(*result.best, *found.best)))
      found = result;
    found.seen = std::move(seen);
    stopped = stopped || result.end == SearchEnd::stopped;
    found.asked = asked;
    found.failed = failed;
  }
  if (stopped)
    found.end = SearchEnd::stopped;
  return found;
}

/// No search may end below a design that was there before it.
void take_known(const Problem& problem, const std::vector<std::vector<double>>& known, SearchResult& found,
                Monitor& monitor) {
  Recorder recorder(problem, known.size(), monitor);
  try {
    for (const auto& y : known)
      (void)recorder.evaluate(y);
  } catch (const Recorder::Ended& end) {
    found.end = end.end;
  }
  const SearchResult& result = recorder.result();
  found.asked += result.asked;
  found.failed += result.failed;
  if (result.best && (!found.best || better(*result.best, *found.best)))
    found.best = result.best;
  found.seen.insert(found.seen.end(), result.seen.begin(), result.seen.end());
}

} // namespace

std::span<const std::string_view> method_names() {
  static const auto names = [] {
    std::vector<std::string_view> all{global_method};
    const auto nlopt = nlopt_method_names();
    all.insert(all.end(), nlopt.begin(), nlopt.end());
    if (ipopt_available())
      all.push_back(ipopt_method);
    return all;
  }();
  return names;
}

OptimiseResult optimise(const Problem& problem, const OptimiseSettings& settings, Evaluator& fresh,
                        Monitor& monitor) {
  const std::size_t budget = settings.search.budget;
  OptimiseSettings search = settings;
  search.search.budget = std::max<std::size_t>(1, 3 * budget / 4);
  SearchResult found = settings.search.method == global_method ? global_then_polish(problem, search, monitor)
                                                               : multi_start(problem, search, monitor);
  if (found.end != SearchEnd::stopped)
    take_known(problem, settings.known, found, monitor);
  const std::size_t left = budget > found.asked ? budget - found.asked : 0;
  const bool at_rest = found.end != SearchEnd::stopped && found.end != SearchEnd::all_failed;
  const bool confirmed = at_rest && confirm(problem, found, settings.search, left, monitor);
  return {judge(problem, found, confirmed, fresh), found};
}

} // namespace strainwave
