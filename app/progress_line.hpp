#pragma once
// How far a study is, on stderr: one line that is redrawn on a terminal, a line every 30 s elsewhere.

#include "strainwave/optimize/methods/monitor.hpp"

#include <chrono>
#include <optional>
#include <string>

namespace strainwave::app {

class ProgressLine {
public:
  ProgressLine();
  ~ProgressLine(); ///< clears the line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Would show() print now? Then a line is worth being made.
  bool due();
  void show(const std::string& line);

private:
  using Clock = std::chrono::steady_clock;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point last_;
};

/// How far a search is.
class SearchLine {
public:
  /// `output` and `unit` of the objective.
  SearchLine(std::string output, std::string unit);
  /// One thread at a time. `seconds_left`: until a time limit.
  void show(const SearchProgress& progress, std::optional<double> seconds_left);

private:
  std::string output_, unit_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  ProgressLine line_;
};

} // namespace strainwave::app
