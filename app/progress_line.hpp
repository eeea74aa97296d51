#pragma once
// How far a search is, on stderr: one line that is redrawn on a terminal, a line every 30 s elsewhere.

#include "optimize/monitor.hpp"

#include <chrono>
#include <optional>
#include <string>

namespace strainwave::app {

class ProgressLine {
public:
  /// `output` and `unit` of the objective.
  ProgressLine(std::string output, std::string unit);
  ~ProgressLine(); ///< clears the line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// One thread at a time. `seconds_left`: until a time limit.
  void show(const SearchProgress& progress, std::optional<double> seconds_left);

private:
  using Clock = std::chrono::steady_clock;
  std::string output_, unit_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point begin_, last_;
};

} // namespace strainwave::app
