#include "strainwave/optimize/methods/start_points.hpp"
#include "tests/optimize/function_evaluator.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace strainwave {
namespace {

TEST(StartPoints, BeginWithTheStudysStartAndStayInTheBox) {
  const DesignSpace design = box_design({{0, 10, 4}, {-1, 1, 0}});
  const auto points = start_points(design, 50, 1);
  ASSERT_EQ(points.size(), 50u);
  EXPECT_EQ(points[0], design.scaled(design.start()));
  for (const auto& y : points)
    for (const double coordinate : y)
      EXPECT_TRUE(coordinate >= 0.0 && coordinate <= 1.0);
}

TEST(StartPoints, ShorterListsAreTheBeginningOfLongerOnes) {
  const DesignSpace design = box_design({{0, 10, 4}, {-1, 1, 0}, {0, 1, 0}});
  const auto few = start_points(design, 5, 9);
  const auto many = start_points(design, 12, 9);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  EXPECT_NE(start_points(design, 5, 10)[1], few[1]);
}

TEST(StartPoints, LeaveNoQuarterOfASquareEmpty) {
  const auto points = start_points(box_design({{0, 1, 0}, {0, 1, 0}}), 13, 3);
  int quarter[4] = {};
  for (std::size_t k = 1; k < points.size(); ++k)
    ++quarter[(points[k][0] > 0.5) + 2 * (points[k][1] > 0.5)];
  EXPECT_GE(*std::min_element(quarter, quarter + 4),
            2); // 12 points; random ones would miss this every other time
}

} // namespace
} // namespace strainwave
