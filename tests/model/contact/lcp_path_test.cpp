// The event path: against direct solves, ties, ends, torque control.

#include "model/contact/lcp_path.hpp"
#include "tests/model/contact/lcp_problems.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

using namespace contact_problems;

const std::string folder = STRAINWAVE_TEST_REFERENCE;

/// Largest difference of forces between the path and direct solves at 1000 rotations, relative to the largest force there.
double largest_difference(const ContactProblem& problem, const EventPath& path, double from, double to) {
  ContactSolver solver;
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double rotation = from + (to - from) * i / 999.0;
    const ContactState direct = solver.solve_at(problem, rotation), on_path = path.at(rotation);
    const double scale = direct.force.cwiseAbs().maxCoeff();
    const double difference = (direct.force - on_path.force).cwiseAbs().maxCoeff();
    worst = std::max(worst, scale > 0.0 ? difference / scale : difference);
    EXPECT_TRUE(certify(problem, on_path).holds(1e-11)) << rotation;
  }
  return worst;
}

TEST(LcpPath, EqualsDirectSolvesOnTheSeedGear) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  ContactSolver solver;
  const EventPath path = solver.trace(problem, {.end_rotation = 6e-3});
  EXPECT_EQ(path.end(), EventPath::End::rotation);
  EXPECT_TRUE(path.contact());
  EXPECT_LT(largest_difference(problem, path, 0.0, 6e-3), 1e-12);
}

TEST(LcpPath, EqualsDirectSolvesOnAWholeCircleOfTeeth) {
  const ContactProblem problem = smooth(140);
  ContactSolver solver;
  const EventPath path = solver.trace(problem, {.end_rotation = 8e-3});
  EXPECT_LT(largest_difference(problem, path, 0.0, 8e-3), 1e-12);
}

TEST(LcpPath, EqualsDirectSolvesWithTheDiscsInTheProblem) {
  ContactSolver solver;
  const ContactProblem problem =
      seed_on_discs(read_json(folder + "/load-path.json"), read_json(folder + "/unit-responses.json"), solver);
  const EventPath path = solver.trace(problem, {.end_rotation = 4.5e-3});
  EXPECT_LT(largest_difference(problem, path, 0.0, 4.5e-3), 1e-12);
  std::printf("events %zu, torque at the end %.3f N m, solves %d\n", path.events().size(), 2e-3 * path.end_torque(),
              path.linear_solves());
  for (const double theta : {1e-3, 2e-3, 3.38e-3, 4.5e-3}) {
    const ContactState state = solver.solve_at(problem, theta);
    std::printf("%g: %.3f N m, peak %.2f, its %d, fallback %d closed %d\n", theta, 2e-3 * state.torque,
                state.force.head(28).maxCoeff(), state.iterations, state.fallback,
                static_cast<int>(std::count(state.active.begin(), state.active.end(), 1)));
  }
}

TEST(LcpPath, SymmetricGapsCloseExactlyInPairs) {
  const ContactProblem problem = ties();
  ContactSolver solver;
  const EventPath path = solver.trace(problem, {.end_rotation = 0.05});
  ASSERT_EQ(path.events().size(), 14u);
  for (int k = 0; k < 14; ++k) {
    const auto changes = path.changes(path.events()[static_cast<std::size_t>(k)]);
    ASSERT_EQ(changes.size(), 2u);
    EXPECT_EQ(changes[0].index, 13 - k);
    EXPECT_EQ(changes[1].index, 14 + k);
    EXPECT_TRUE(changes[0].closes && changes[1].closes);
  }
}

} // namespace
} // namespace strainwave
