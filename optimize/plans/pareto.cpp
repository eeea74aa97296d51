#include "strainwave/optimize/plans/pareto.hpp"

#include "strainwave/optimize/plans/global_then_polish.hpp"

#include <algorithm>
#include <iterator>

namespace strainwave {

namespace {

constexpr double share_of_first_end = 0.35;
constexpr double share_of_second_end = 0.25;

class Front {
public:
  Front(const ParetoSettings& settings, Evaluator& fresh, Monitor& monitor)
      : settings_(settings), fresh_(fresh), monitor_(monitor) {}

  /// A search of the whole box.
  ParetoPoint end(const Problem& problem, double share) {
    OptimiseSettings settings = settings_.each;
    settings.search.budget = part(share);
    OptimiseResult result = optimise(problem, settings, fresh_, monitor_);
    remember(result.found.seen);
    return {{}, std::move(result.judgement)};
  }

  /// From the best designs met so far.
  ParetoPoint between(const Problem& problem, double bound, double share) {
    std::vector<SearchPoint> known;
    for (const auto& y : seen_)
      known.push_back(problem.at(y));
    const std::size_t starts = std::max<std::size_t>(1, settings_.each.starts);
    SearchResult found = polish_all(problem, best_apart(problem, std::move(known), starts, 0.05),
                                    settings_.each, part(0.7 * share), monitor_);
    remember(found.seen);
    const bool stopped = found.end == SearchEnd::stopped;
    const bool confirmed =
        !stopped && confirm(problem, found, settings_.each.search, part(0.3 * share), monitor_);
    return {bound, judge(problem, found, confirmed, fresh_)};
  }

private:
  std::size_t part(double share) const {
    return static_cast<std::size_t>(share * static_cast<double>(settings_.each.search.budget)) + 1;
  }
  void remember(const std::vector<SearchPoint>& points) {
    for (const SearchPoint& point : points)
      seen_.push_back(point.y);
  }

  const ParetoSettings& settings_;
  Evaluator& fresh_;
  Monitor& monitor_;
  std::vector<std::vector<double>> seen_;
};

bool is_design(const ParetoPoint& point) {
  const Verdict verdict = point.judgement.verdict;
  return verdict != Verdict::infeasible && verdict != Verdict::stopped && point.judgement.best;
}

} // namespace

std::vector<ParetoPoint> pareto_front(const Problem& problem, const Objective& second,
                                      const ParetoSettings& settings, Evaluator& fresh, Monitor& monitor) {
  Front front(settings, fresh, monitor);
  std::vector<ParetoPoint> points;
  points.push_back(front.end(problem, share_of_first_end));
  if (!is_design(points.front()))
    return points;
  const Problem other = problem.aiming_at(second);
  const ParetoPoint last = front.end(other, share_of_second_end);
  if (!is_design(last)) {
    points.push_back(last);
    return points;
  }
  const std::size_t response = other.objective_response();
  const double from = points.front().judgement.fresh->values[response];
  const double to = last.judgement.fresh->values[response];
  const std::size_t count = std::max<std::size_t>(2, settings.points);
  const double share = (1.0 - share_of_first_end - share_of_second_end) / static_cast<double>(count - 1);
  for (std::size_t j = 1; j < count; ++j) {
    // At the last end itself ε leaves f what freedom the second aim's optimum has.
    const double bound =
        j + 1 == count ? to : from + (to - from) * static_cast<double>(j) / static_cast<double>(count - 1);
    points.push_back(front.between(problem.limited(second, bound), bound, share));
    if (points.back().judgement.verdict == Verdict::stopped)
      break;
  }
  return points;
}

} // namespace strainwave
