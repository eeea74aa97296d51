// Marching with step halving against the exact event path.

#include "strainwave/model/lcp/march.hpp"
#include "strainwave/model/lcp/path.hpp"
#include "tests/model/lcp/problems.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

using namespace contact_problems;

TEST(LcpMarch, ConvergesToTheEventPathWithFirstOrder) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  ContactSolver solver;
  const EventPath path = solver.trace(problem, {.end_rotation = 5e-3});
  double first = 0.0, before = 0.0;
  for (const double least : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    const March marched = march(problem, 0.0, 5e-3, {.step = 1e-4, .least_step = least}, solver);
    EXPECT_GT(marched.halved, 0);
    // Polygon against polygon: the difference is largest at the kinks.
    double square = 0.0;
    for (const PathEvent& event : path.events()) {
      const double error = std::abs(marched.torque_at(event.rotation) - event.torque);
      // A chord of width h across a kink: jump × h / 4 at most.
      EXPECT_LE(error,
                0.25 * least * std::abs(event.stiffness_after - event.stiffness_before) * (1.0 + 1e-6) +
                    1e-9);
      square += error * error;
    }
    const double rms = std::sqrt(square / static_cast<double>(path.events().size()));
    std::printf("    least step %.0e  error %.3e N mm  order %.2f  steps %d\n", least, rms,
                before > 0.0 ? std::log10(before / rms) : 0.0, marched.tried);
    before = rms;
    if (first == 0.0)
      first = rms;
  }
  // Where a kink falls inside its last step is chance, a factor of a few either way: the order over all four
  // decades.
  EXPECT_NEAR(std::log10(first / before) / 4.0, 1.0, 0.25);
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
  EXPECT_THROW((void)march(problem, 0.0, 0.02, {.step = 1e-3, .least_step = 0.0}, solver),
               std::invalid_argument);
}

} // namespace
} // namespace strainwave
