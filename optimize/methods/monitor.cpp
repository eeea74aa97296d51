#include "strainwave/optimize/methods/monitor.hpp"

namespace strainwave {

Monitor::Monitor(std::size_t budget, std::function<bool()> stop,
                 std::function<void(const SearchProgress&)> report)
    : stop_(std::move(stop)), report_(std::move(report)) {
  progress_.budget = budget;
}

void Monitor::note(const Problem& problem, const SearchPoint& point) {
  const std::lock_guard lock(mutex_);
  ++progress_.asked;
  if (!best_ || better(point, *best_))
    best_ = point;
  progress_.feasible = feasible(*best_);
  if (progress_.feasible)
    progress_.objective = problem.unscaled_objective(*best_);
  if (report_)
    report_(progress_);
}

} // namespace strainwave
