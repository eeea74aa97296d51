#include "app/progress_line.hpp"

#include "app/output.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace strainwave::app {

ProgressLine::ProgressLine(std::string output, std::string unit)
    : output_(std::move(output)), unit_(std::move(unit)), terminal_(isatty(STDERR_FILENO) == 1),
      begin_(Clock::now()), last_(begin_) {}

ProgressLine::~ProgressLine() {
  if (drawn_)
    std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(const SearchProgress& progress, std::optional<double> seconds_left) {
  using namespace std::chrono_literals;
  const auto now = Clock::now();
  if (now - last_ < (terminal_ ? Clock::duration(100ms) : Clock::duration(30s)))
    return;
  last_ = now;
  const double spent = std::chrono::duration<double>(now - begin_).count();
  double left = spent * (static_cast<double>(progress.budget) / static_cast<double>(progress.asked) - 1.0);
  if (seconds_left)
    left = std::min(left, *seconds_left);
  const std::string best = progress.objective ? fmt::format("{} {:.5g}{}{}", output_, *progress.objective,
                                                            unit_.empty() ? "" : " ", unit_)
                                              : std::string("no feasible design yet");
  const std::string line = fmt::format("{} of at most {} evaluations, best {}, at most {:.0f} s left",
                                       progress.asked, progress.budget, best, std::max(0.0, left));
  if (!terminal_)
    return report(line);
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

} // namespace strainwave::app
