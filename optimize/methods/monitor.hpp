#pragma once
// The line between a running search and whoever started it: progress outwards, the wish to stop inwards.

#include "strainwave/optimize/problem/problem.hpp"

#include <functional>
#include <mutex>
#include <optional>

namespace strainwave {

struct SearchProgress {
  std::size_t asked = 0; ///< points that searches have asked for
  std::size_t budget = 0;
  bool feasible = false;           ///< a feasible point is known
  std::optional<double> objective; ///< best feasible one so far, in the unit of its response
};

/// Thread-safe; one for all searches of a study.
class Monitor {
public:
  /// `stop` is asked before every evaluation, `report` told after every one, never by two threads at once.
  explicit Monitor(std::size_t budget = 0, std::function<bool()> stop = {},
                   std::function<void(const SearchProgress&)> report = {});

  bool stop_requested() const { return stop_ && stop_(); }
  void note(const Problem& problem, const SearchPoint& point);

private:
  std::function<bool()> stop_;
  std::function<void(const SearchProgress&)> report_;
  std::mutex mutex_;
  SearchProgress progress_;
  std::optional<SearchPoint> best_;
};

} // namespace strainwave
