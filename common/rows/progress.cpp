#include "strainwave/common/rows/progress.hpp"

#include <cmath>
#include <fmt/format.h>

namespace strainwave {

double RunProgress::rows_per_second() const {
  return seconds > 0.0 ? static_cast<double>(done - reused) / seconds : 0.0;
}

double RunProgress::seconds_left() const {
  const double rate = rows_per_second();
  return rate > 0.0 ? static_cast<double>(total - done) / rate : 0.0;
}

std::string duration_text(double seconds) {
  const auto s = static_cast<long long>(std::ceil(seconds));
  if (s < 60)
    return fmt::format("{} s", s);
  if (s < 3600)
    return fmt::format("{} min {} s", s / 60, s % 60);
  if (s < 86400)
    return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
  return fmt::format("{} d {} h", s / 86400, s % 86400 / 3600);
}

std::string progress_line(const RunProgress& p) {
  const double share =
      p.total > 0 ? 100.0 * static_cast<double>(p.done) / static_cast<double>(p.total) : 100.0;
  std::string line = fmt::format("{:.1f} %  {} of {} rows", share, p.done, p.total);
  if (p.reused > 0)
    line += fmt::format(", {} known before", p.reused);
  if (p.failed > 0)
    line += fmt::format(", {} failed", p.failed);
  if (const double rate = p.rows_per_second(); rate > 0.0 && p.done < p.total)
    line += fmt::format(", {:.3g} rows/s, {} left", rate, duration_text(p.seconds_left()));
  return line;
}

} // namespace strainwave
