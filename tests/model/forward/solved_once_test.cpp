// A cup is solved once: by however many threads, and for whatever is asked of its gears.

#include "strainwave/common/threads/parallel.hpp"
#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/forward/gradient.hpp"
#include "strainwave/model/forward/ring_pair.hpp"
#include "strainwave/model/loading/contact_forces.hpp"
#include "strainwave/model/loading/phase_problem.hpp"
#include "tests/support/coarse_seed.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

Gear gear_with_relief(double tip_relief_um) {
  Gear gear = testing_support::coarse_seed_gear(testing_support::coarsest_mesh);
  gear.load.torque_nm = {7.0};
  gear.load.phases = 2;
  gear.load.direction = Direction::both;
  gear.flank_modification.flexspline.tip_relief_um = tip_relief_um;
  return gear;
}

TEST(SolvedOnce, ManyThreadsShareOneCupAndGetTheBitsOfOne) {
  constexpr std::size_t gears = 8;
  std::vector<ForwardResult> alone, together(gears);
  for (std::size_t k = 0; k < gears; ++k) {
    const ForwardModel model({.disk_cache = false, .threads = 1});
    alone.push_back(model.analyze(gear_with_relief(0.5 * static_cast<double>(k))));
  }
  const ForwardModel model({.disk_cache = false, .threads = 1});
  const std::uint64_t before = cups_solved();
  parallel_for(gears, 4, [&](std::size_t k) {
    together[k] = model.analyze(gear_with_relief(0.5 * static_cast<double>(k)));
  });
  EXPECT_EQ(cups_solved() - before, 1u);
  for (std::size_t k = 0; k < gears; ++k) {
    ASSERT_EQ(together[k].status, Status::ok) << together[k].message;
    ASSERT_EQ(together[k].load.size(), alone[k].load.size());
    for (std::size_t i = 0; i < alone[k].load.size(); ++i) {
      EXPECT_EQ(together[k].load[i].force_n, alone[k].load[i].force_n);
      EXPECT_EQ(together[k].load[i].rotation_rad, alone[k].load[i].rotation_rad);
    }
  }
}

TEST(SolvedOnce, EverythingThatIsAskedOfAGearReadsTheSameStages) {
  const ForwardModel model({.disk_cache = false});
  const Gear gear = gear_with_relief(2.0);
  const std::uint64_t before = cups_solved();
  std::shared_ptr<const ForwardSolution> solution;
  ASSERT_EQ(model.analyze(gear).status, Status::ok);
  ASSERT_EQ(model.analyze(gear, solution).status, Status::ok);
  ASSERT_TRUE(model.contact_states(gear).ok());
  ASSERT_TRUE(model.phase_problems(gear).ok());
  ASSERT_TRUE(nominal_mesh(model, gear).ok());
  EXPECT_EQ(cups_solved() - before, 1u);
}

TEST(SolvedOnce, ASolutionOutlivesItsModel) {
  const std::vector<std::string> path = {"flank_modification.flexspline.tip_relief_um"};
  std::shared_ptr<const ForwardSolution> solution;
  Eigen::VectorXd kept;
  {
    const ForwardModel model({.disk_cache = false});
    ASSERT_EQ(model.analyze(gear_with_relief(2.0), solution).status, Status::ok);
    kept = solution->gradient(path).assembly_force_n;
  }
  EXPECT_EQ(solution->gradient(path).assembly_force_n, kept);
}

} // namespace
} // namespace strainwave
