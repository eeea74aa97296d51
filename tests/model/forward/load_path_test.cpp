// The exact load path against direct solutions: at every load, and between all its events.

#include "strainwave/model/results/load_path.hpp"

#include "strainwave/model/forward/forward.hpp"
#include "tests/model/forward/shared_model.hpp"
#include "tests/support/coarse_seed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace strainwave {
namespace {

using testing_support::shared_model;

Gear linearised(Gear gear) {
  gear.contact.disc_gap = DiscGap::linearised;
  return gear;
}

/// The path's numbers at every load against an analysis, to 1e-9 of them; with the exact disc gap the path is
/// what the analysis says its correction was made to.
void expect_direct_results(const Gear& gear, const LoadPath& path) {
  const ForwardResult direct = shared_model().analyze(gear);
  ASSERT_EQ(direct.status, Status::ok) << direct.message;
  ASSERT_EQ(path.loads.size(), direct.load.size());
  const double rad = 1e-9 * path.end_rotation_rad, nm = 1e-9 * path.end_torque_nm;
  const bool exact = gear.contact.disc_gap == DiscGap::exact;
  for (std::size_t k = 0; k < path.loads.size(); ++k) {
    const LoadOnPath& on = path.loads[k];
    const LoadResult& load = direct.load[k];
    EXPECT_LE(on.direct_difference, 1e-9) << k;
    EXPECT_EQ(on.exact_minus_path_rad.has_value(), exact && on.at_torque) << k;
    EXPECT_EQ(on.exact_minus_path_nm.has_value(), exact && !on.at_torque) << k;
    EXPECT_NEAR(on.rotation_rad + on.exact_minus_path_rad.value_or(0.0), load.rotation_rad, rad) << k;
    EXPECT_NEAR(on.torque_nm + on.exact_minus_path_nm.value_or(0.0), load.torque_nm, nm) << k;
    if (on.exact_minus_path_rad) {
      EXPECT_NEAR(*on.exact_minus_path_rad, load.gap_correction_rotation_rad, rad) << k;
    }
  }
}

/// Joins minus leaves of the whole path: the flanks' points that carry at its end.
int carrying_points(const LoadPath& path) {
  auto count = static_cast<int>(path.carries_at_start.size());
  for (const LoadPathEvent& event : path.events)
    for (const LoadPathChange& change : event.changes)
      count += change.joins ? 1 : -1;
  return count;
}

int carrying_points(const LoadResult& load) {
  const std::vector<double>& force = load.points.tooth.empty() ? load.force_n : load.points.force_n;
  return static_cast<int>(std::count_if(force.begin(), force.end(), [](double f) { return f > 0.0; }));
}

TEST(LoadPath, OnePointATooth_PassesThroughTheDirectResultAtEveryLoad) {
  Gear gear = linearised(seed_gear());
  gear.load.torque_nm = {0.28, 1.0, 3.5, 7.0, 11.5};
  gear.load.rotation_rad = {0.2e-3, 2e-3};
  const auto path = shared_model().load_path(gear);
  ASSERT_TRUE(path) << path.failure().message;
  expect_direct_results(gear, *path);
  EXPECT_EQ(path->start_rotation_rad, 0.0);
  EXPECT_EQ(path->start_torque_nm, 0.0);
  EXPECT_TRUE(path->carries_at_start.empty());
  const ForwardResult end = shared_model().analyze(gear);
  EXPECT_EQ(carrying_points(*path), carrying_points(end.load[4]));
  EXPECT_NEAR(path->events.front().torque_nm, 0.0, 1e-12);
  EXPECT_EQ(path->events.front().changes.size(), 1U); // the first tooth alone
}

TEST(LoadPath, OfTheExactDiscGapIsWhatItsCorrectionStartsFrom) {
  Gear gear = seed_gear();
  gear.load.rotation_rad = {2e-3};
  const auto path = shared_model().load_path(gear);
  ASSERT_TRUE(path) << path.failure().message;
  expect_direct_results(gear, *path);
  // of second order in the wall's gaps: visible, and small
  EXPECT_GT(std::abs(*path->loads[1].exact_minus_path_rad), 1e-7);
  EXPECT_LT(std::abs(*path->loads[1].exact_minus_path_rad), 1e-2 * path->loads[1].rotation_rad);
}

// An event too many, too few or in the wrong place would show in a stiffness or a number of teeth between
// two.
TEST(LoadPath, BetweenAllEventsStiffnessAndTeethAreThoseOfDirectSolutions) {
  Gear gear = linearised(seed_gear());
  const auto path = shared_model().load_path(gear);
  ASSERT_TRUE(path) << path.failure().message;
  ASSERT_GT(path->events.size(), 20U);
  gear.load.torque_nm.clear();
  std::vector<int> engaged;
  std::vector<double> stiffness;
  int teeth = 0;
  for (std::size_t k = 0; k < path->events.size(); ++k) {
    const LoadPathEvent& event = path->events[k];
    for (const LoadPathChange& change : event.changes) {
      EXPECT_TRUE(change.whole_tooth); // one point a tooth
      teeth += change.joins ? 1 : -1;
    }
    const double next =
        k + 1 < path->events.size() ? path->events[k + 1].rotation_rad : path->end_rotation_rad;
    gear.load.rotation_rad.push_back(0.5 * (event.rotation_rad + next));
    engaged.push_back(teeth);
    stiffness.push_back(event.stiffness_nm_per_rad);
  }
  const ForwardResult between = shared_model().analyze(gear);
  ASSERT_EQ(between.load.size(), engaged.size());
  for (std::size_t k = 0; k < engaged.size(); ++k) {
    EXPECT_EQ(between.load[k].engaged_count, engaged[k]) << k;
    EXPECT_NEAR(between.load[k].tangent_stiffness_nm_per_rad, stiffness[k], 1e-9 * stiffness[k]) << k;
    EXPECT_NEAR(torque_at(*path, between.load[k].rotation_rad), between.load[k].torque_nm, 1e-8) << k;
  }
}

TEST(LoadPath, ConedCupWith9x9Points_PassesThroughTheDirectResultAtEveryLoad) {
  Gear gear = linearised(testing_support::coarse_seed_gear(testing_support::two_row_mesh));
  gear.circular_spline.profile_shift = 2.4132;
  gear.contact.window_deg = {-30.0, 45.0};
  gear.contact.flank_points = 9;
  gear.contact.face_slices = 9;
  gear.contact.gaps = GapModel::assembled;
  gear.load.torque_nm = {1.0, 4.0, 7.0, 11.5};
  gear.load.rated_torque_nm = 0.0;
  const auto path = shared_model().load_path(gear);
  ASSERT_TRUE(path) << path.failure().message;
  expect_direct_results(gear, *path);
  const ForwardResult direct = shared_model().analyze(gear);
  EXPECT_EQ(carrying_points(*path), carrying_points(direct.load[3]));
  // Every tooth joins once as a whole, before its other points.
  std::set<int> joined;
  int points = 0;
  for (const LoadPathEvent& event : path->events)
    for (const LoadPathChange& change : event.changes) {
      if (change.joins && change.whole_tooth)
        joined.insert(change.point.tooth);
      EXPECT_TRUE(joined.contains(change.point.tooth));
      ++points;
    }
  EXPECT_EQ(static_cast<int>(joined.size()), direct.load[3].engaged_count);
  EXPECT_GT(points, 3 * direct.load[3].engaged_count);
}

TEST(LoadPath, WedgedGearStartsAtRestWithForcesOnBothFlanks) {
  Gear gear = linearised(seed_gear());
  gear.circular_spline.profile_shift = 2.1;
  gear.load.torque_nm = {0.1, 7.0};
  gear.load.rated_torque_nm = 0.0;
  const auto path = shared_model().load_path(gear);
  ASSERT_TRUE(path) << path.failure().message;
  expect_direct_results(gear, *path);
  EXPECT_NEAR(path->start_torque_nm, 0.0, 1e-9);
  EXPECT_GT(path->start_stiffness_nm_per_rad, 0.0);
  int coast = 0;
  for (const PathPoint& point : path->carries_at_start)
    coast += point.coast;
  EXPECT_GT(coast, 0);
  EXPECT_EQ(2 * coast, static_cast<int>(path->carries_at_start.size()));
  for (const LoadPathEvent& event : path->events)
    for (const LoadPathChange& change : event.changes)
      if (change.point.coast)
        coast += change.joins ? 1 : -1;
  const std::vector<double> force = shared_model().analyze(gear).load[1].coast.force_n;
  EXPECT_EQ(coast, std::count_if(force.begin(), force.end(), [](double f) { return f > 0.0; }));
}

TEST(LoadPath, FrozenWallHasNoEventsAndItsPathIsExactForAnyDiscGap) {
  Gear gear = seed_gear();
  gear.contact.fidelity = Fidelity::linear;
  const auto path = shared_model().load_path(gear);
  ASSERT_TRUE(path) << path.failure().message;
  const ForwardResult direct = shared_model().analyze(gear);
  ASSERT_EQ(path->loads.size(), direct.load.size());
  for (std::size_t k = 0; k < path->loads.size(); ++k) {
    EXPECT_NEAR(path->loads[k].rotation_rad, direct.load[k].rotation_rad, 1e-9 * path->end_rotation_rad);
    EXPECT_FALSE(path->loads[k].exact_minus_path_rad);
  }
  for (const LoadPathEvent& event : path->events)
    EXPECT_EQ(event.wall_joins + event.wall_leaves, 0);
}

TEST(LoadPath, WithoutAnyLoadThereIsNone) {
  Gear gear = seed_gear();
  gear.load.torque_nm.clear();
  gear.load.rated_torque_nm = 0.0;
  const auto path = shared_model().load_path(gear);
  ASSERT_FALSE(path);
  EXPECT_EQ(path.failure().status, Status::contradiction);
  EXPECT_NE(path.failure().message.find("load.torque_nm"), std::string::npos);
}

TEST(LoadPath, ReadsRotationAndTorqueOffItsStraightLines) {
  LoadPath path;
  path.events = {{.rotation_rad = 1.0, .torque_nm = 0.0, .stiffness_nm_per_rad = 2.0},
                 {.rotation_rad = 2.0, .torque_nm = 2.0, .stiffness_nm_per_rad = 4.0}};
  path.end_rotation_rad = 3.0;
  EXPECT_EQ(rotation_at(path, 0.0), 1.0); // the largest without load
  EXPECT_EQ(rotation_at(path, 1.0), 1.5);
  EXPECT_EQ(rotation_at(path, 6.0), 3.0);
  EXPECT_EQ(torque_at(path, 0.5), 0.0);
  EXPECT_EQ(torque_at(path, 1.5), 1.0);
  EXPECT_EQ(torque_at(path, 2.5), 4.0);
}

} // namespace
} // namespace strainwave
