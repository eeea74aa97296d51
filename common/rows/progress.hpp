#pragma once
// How far a run is, in numbers and in one line for people.

#include <cstdint>
#include <string>

namespace strainwave {

struct RunProgress {
  std::uint64_t total = 0;  ///< rows of this shard
  std::uint64_t done = 0;   ///< reused ones included
  std::uint64_t reused = 0; ///< known from the journal
  std::uint64_t failed = 0;
  double seconds = 0.0; ///< since this run began

  double rows_per_second() const;
  double seconds_left() const; ///< at the rate so far; 0 while there is none
};

/// "12.0 %  120000 of 1000000 rows, 35 failed, 52300 rows/s, 17 s left"
std::string progress_line(const RunProgress&);

/// "17 s", "4 min 10 s", "3 h 20 min", "2 d 3 h"
std::string duration_text(double seconds);

} // namespace strainwave
