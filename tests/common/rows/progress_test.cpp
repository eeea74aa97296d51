#include "strainwave/common/rows/progress.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(Progress, SaysDoneFailedRateAndTimeLeft) {
  EXPECT_EQ(progress_line({.total = 1000000, .done = 120000, .reused = 20000, .failed = 35, .seconds = 10.0}),
            "12.0 %  120000 of 1000000 rows, 20000 known before, 35 failed, 1e+04 rows/s, 1 min 28 s left");
  EXPECT_EQ(progress_line({.total = 500, .done = 500, .seconds = 2.0}), "100.0 %  500 of 500 rows");
}

TEST(Progress, DurationsAreReadable) {
  EXPECT_EQ(duration_text(16.2), "17 s");
  EXPECT_EQ(duration_text(250.0), "4 min 10 s");
  EXPECT_EQ(duration_text(12000.0), "3 h 20 min");
  EXPECT_EQ(duration_text(183600.0), "2 d 3 h");
}

} // namespace
} // namespace strainwave
