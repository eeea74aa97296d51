#include "app/progress_line.hpp"

#include "app/output.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace strainwave::app {

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) == 1), last_(Clock::now()) {}

ProgressLine::~ProgressLine() {
  if (drawn_)
    std::fputs("\r\033[K", stderr);
}

bool ProgressLine::due() {
  using namespace std::chrono_literals;
  const auto now = Clock::now();
  if (now - last_ < (terminal_ ? Clock::duration(100ms) : Clock::duration(30s)))
    return false;
  last_ = now;
  return true;
}

void ProgressLine::show(const std::string& line) {
  if (!terminal_)
    return report(line);
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

SearchLine::SearchLine(std::string output, std::string unit)
    : output_(std::move(output)), unit_(std::move(unit)) {}

void SearchLine::show(const SearchProgress& progress, std::optional<double> seconds_left) {
  if (!line_.due())
    return;
  const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  double left = spent * (static_cast<double>(progress.budget) / static_cast<double>(progress.asked) - 1.0);
  if (seconds_left)
    left = std::min(left, *seconds_left);
  const std::string best = progress.objective ? fmt::format("{} {:.5g}{}{}", output_, *progress.objective,
                                                            unit_.empty() ? "" : " ", unit_)
                                              : std::string("no feasible design yet");
  line_.show(fmt::format("{} of at most {} evaluations, best {}, at most {:.0f} s left", progress.asked,
                         progress.budget, best, std::max(0.0, left)));
}

} // namespace strainwave::app
