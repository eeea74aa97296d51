// Marching with step halving against the exact event path.

#include "model/contact/lcp_march.hpp"
#include "model/contact/lcp_path.hpp"
#include "tests/model/contact/lcp_problems.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

using namespace contact_problems;

const std::string folder = STRAINWAVE_TEST_REFERENCE;

TEST(LcpMarch, ConvergesToTheEventPathWithFirstOrder) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  ContactSolver solver;
  const EventPath path = solver.trace(problem, {.end_rotation = 5e-3});
  std::vector<double> error;
  double jump = 0.0;
  for (const PathEvent& e : path.events()) jump = std::max(jump, std::abs(e.stiffness_after - e.stiffness_before));
  for (const double least : {1e-5, 1e-6, 1e-7, 1e-8}) {
    const March marched = march(problem, 0.0, 5e-3, {.step = 1e-4, .least_step = least}, solver);
    double worst = 0.0;
    for (int i = 0; i <= 200000; ++i) {
      const double rotation = 5e-3 * i / 200000.0;
      worst = std::max(worst, std::abs(marched.torque_at(rotation) - path.torque_at(rotation)));
    }
    error.push_back(worst);
    // A chord across one kink is off by jump × h / 4 at most; a least step may hold several kinks.
    EXPECT_LE(worst, jump * least) << least;
    EXPECT_GT(marched.halved, 0);
  }
  EXPECT_LT(error[1], 0.2 * error[0]);
  EXPECT_LT(error[2], 0.2 * error[1]);
}

TEST(LcpMarch, FindsEveryEventWithinItsLeastStep) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  ContactSolver solver;
  const EventPath path = solver.trace(problem, {.end_rotation = 5e-3});
  for (const double least : {1e-5, 1e-7, 1e-9}) {
    const March marched = march(problem, 0.0, 5e-3, {.step = 2e-4, .least_step = least}, solver);
    ASSERT_EQ(marched.changes.size(), path.events().size()) << least;
    for (std::size_t k = 0; k < marched.changes.size(); ++k) {
      const PathEvent& event = path.events()[k];
      ASSERT_EQ(event.change_count, 1);
      EXPECT_EQ(marched.changes[k].index, path.changes(event)[0].index);
      EXPECT_EQ(marched.changes[k].closes, path.changes(event)[0].closes);
      const double late = marched.changes[k].rotation - event.rotation;
      EXPECT_GE(late, -1e-15);
      EXPECT_LE(late, least * (1.0 + 1e-6));
    }
  }
}

TEST(LcpMarch, EndsOnTheDirectSolution) {
  const ContactProblem problem = ties();
  ContactSolver solver;
  const March marched = march(problem, 0.0, 0.02, {.step = 1e-3, .least_step = 1e-5}, solver);
  EXPECT_EQ(marched.last.force, solver.solve_at(problem, 0.02).force);
  EXPECT_THROW((void)march(problem, 0.0, 0.02, {.step = 1e-3, .least_step = 0.0}, solver), std::invalid_argument);
}

} // namespace
} // namespace strainwave
