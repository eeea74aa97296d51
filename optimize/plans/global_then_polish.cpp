#include "strainwave/optimize/plans/global_then_polish.hpp"

#include "strainwave/common/threads/parallel.hpp"
#include "strainwave/optimize/methods/ipopt_search.hpp"
#include "strainwave/optimize/methods/nlopt_search.hpp"
#include "strainwave/optimize/methods/start_points.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace strainwave {

namespace {

/// Of a budget; a survey may have asked for one point more than its small share.
std::size_t left_of(std::size_t budget, std::size_t asked) {
  return budget > asked ? budget - asked : 0;
}

/// Evenly spread points, the study's own start first.
SearchResult spread(const Problem& problem, const SearchSettings& settings, Monitor& monitor) {
  Recorder recorder(problem, settings.budget, monitor);
  SearchEnd end = SearchEnd::budget;
  try {
    for (const auto& y : start_points(problem.design(), settings.budget, settings.seed))
      (void)recorder.evaluate(y);
  } catch (const Recorder::Ended& ended) {
    end = ended.end;
  }
  SearchResult result = recorder.result();
  result.end = end;
  return result;
}

void add(SearchResult& all, SearchResult&& one) {
  all.asked += one.asked;
  all.failed += one.failed;
  if (!one.reason.empty())
    all.reason = one.reason;
  if (one.end == SearchEnd::stopped)
    all.end = one.end;
  if (one.best && (!all.best || better(*one.best, *all.best)))
    all.best = one.best;
  std::move(one.seen.begin(), one.seen.end(), std::back_inserter(all.seen));
}

SearchResult survey(const Problem& problem, const OptimiseSettings& settings, std::size_t budget,
                    Monitor& monitor) {
  constexpr std::size_t parts = 3;
  std::vector<SearchResult> results(parts);
  parallel_for(parts, settings.threads, [&](std::size_t part) {
    SearchSettings share = settings.search;
    share.budget = std::max<std::size_t>(1, budget / parts);
    share.method = part == 0 ? "direct_l" : "isres";
    results[part] =
        part == 2 ? spread(problem, share, monitor)
                  : search_nlopt(problem, problem.design().scaled(problem.design().start()), share, monitor);
  });
  SearchResult all;
  all.end = SearchEnd::budget;
  for (SearchResult& result : results)
    add(all, std::move(result));
  return all;
}

/// Down from one point.
SearchResult polish(const Problem& problem, const SearchPoint& from, const SearchSettings& settings,
                    std::size_t budget, Monitor& monitor) {
  SearchResult found;
  if (ipopt_available()) {
    SearchSettings share = settings;
    share.budget = budget / 2;
    found = search_ipopt(problem, from.y, share, monitor);
  }
  if (!found.best || better(from, *found.best))
    found.best = from;
  if (found.end != SearchEnd::stopped)
    (void)confirm(problem, found, settings, left_of(budget, found.asked), monitor);
  return found;
}

} // namespace

std::vector<SearchPoint> best_apart(const Problem& problem, std::vector<SearchPoint> points,
                                    std::size_t count, double separation) {
  const std::vector<double> range = problem.design().scaled_upper();
  const auto distance = [&](const SearchPoint& a, const SearchPoint& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < range.size(); ++i)
      largest = std::max(largest, std::abs(a.y[i] - b.y[i]) / range[i]);
    return largest;
  };
  std::stable_sort(points.begin(), points.end(), better);
  std::vector<SearchPoint> chosen;
  for (const SearchPoint& point : points) {
    if (chosen.size() == count)
      break;
    if (std::all_of(chosen.begin(), chosen.end(),
                    [&](const SearchPoint& c) { return distance(point, c) >= separation; }))
      chosen.push_back(point);
  }
  return chosen;
}

SearchResult global_then_polish(const Problem& problem, const OptimiseSettings& settings, Monitor& monitor) {
  const std::size_t budget = settings.search.budget;
  SearchResult found = survey(problem, settings, budget / 2, monitor);
  if (found.end == SearchEnd::stopped)
    return found;
  const std::size_t n = problem.design().size();
  const double separation =
      0.3 * std::pow(static_cast<double>(found.seen.size() + 1), -1.0 / static_cast<double>(n));
  auto valleys = best_apart(problem, found.seen, std::max<std::size_t>(1, settings.starts), separation);
  // The study's own start is a valley too: a designer's first guess, and where many variables leave a survey
  // thin the best there is. It takes the place of the least promising one.
  const std::vector<double> own = problem.design().scaled(problem.design().start());
  const auto start = std::find_if(found.seen.begin(), found.seen.end(),
                                  [&](const SearchPoint& point) { return point.y == own; });
  const bool known =
      std::any_of(valleys.begin(), valleys.end(), [&](const SearchPoint& point) { return point.y == own; });
  if (start != found.seen.end() && !known && valleys.size() > 1)
    valleys.back() = *start;
  if (!valleys.empty())
    add(found, polish_all(problem, valleys, settings, left_of(budget, found.asked), monitor));
  return found;
}

SearchResult polish_all(const Problem& problem, const std::vector<SearchPoint>& from,
                        const OptimiseSettings& settings, std::size_t budget, Monitor& monitor) {
  std::vector<SearchResult> polished(from.size());
  parallel_for(from.size(), settings.threads, [&](std::size_t k) {
    polished[k] = polish(problem, from[k], settings.search, budget / from.size(), monitor);
  });
  SearchResult found;
  for (SearchResult& result : polished)
    add(found, std::move(result));
  return found;
}

} // namespace strainwave
