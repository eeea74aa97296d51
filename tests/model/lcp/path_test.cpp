// The event path: against direct solves, ties, ends, torque control.

#include "strainwave/model/lcp/path.hpp"
#include "tests/model/lcp/problems.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

using namespace contact_problems;

/// Largest difference of forces between the path and direct solves at 1000 rotations, relative to the largest
/// force there.
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
  const ContactProblem problem = seed_on_discs(read_json(folder + "/load-path.json"),
                                               read_json(folder + "/unit-responses.json"), solver);
  const EventPath path = solver.trace(problem, {.end_rotation = 4.5e-3});
  EXPECT_LT(largest_difference(problem, path, 0.0, 4.5e-3), 1e-12);
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

TEST(LcpPath, TorqueOnTheDiscsIsTheIndependentColumn) {
  // physics: unilateral, linearised gap, one contact point at tip height: N·m at four rotations, peak force
  // at the third, as printed there.
  ContactSolver solver;
  const ContactProblem problem = seed_on_discs(read_json(folder + "/load-path.json"),
                                               read_json(folder + "/unit-responses.json"), solver);
  const EventPath path = solver.trace(problem, {.end_rotation = 4.5e-3});
  EXPECT_NEAR(2e-3 * path.torque_at(1e-3), 2.79, 0.005);
  EXPECT_NEAR(2e-3 * path.torque_at(2e-3), 5.81, 0.005);
  EXPECT_NEAR(2e-3 * path.torque_at(3.38e-3), 11.3, 0.05);
  EXPECT_NEAR(2e-3 * path.torque_at(4.5e-3), 16.3, 0.05);
  EXPECT_NEAR(path.at(3.38e-3).force.head(28).maxCoeff(), 58.4, 0.06);
}

TEST(LcpPath, TorqueNeverFallsAndStiffnessJumpsAsTheKindOfEventSays) {
  ContactSolver solver;
  const ContactProblem problem = seed_on_discs(read_json(folder + "/load-path.json"),
                                               read_json(folder + "/unit-responses.json"), solver);
  const EventPath path = solver.trace(problem, {.end_torque = 6000.0});
  EXPECT_EQ(path.end(), EventPath::End::torque);
  EXPECT_EQ(path.end_torque(), 6000.0);
  double torque = path.start_torque(), rotation = path.start_rotation();
  for (const PathEvent& event : path.events()) {
    EXPECT_GE(event.torque, torque);
    EXPECT_GT(event.rotation, rotation);
    torque = event.torque;
    rotation = event.rotation;
    // r · M_AA⁻¹ r grows with the set: closing stiffens, opening softens.
    if (event.change_count != 1)
      continue;
    const double jump =
        (event.stiffness_after - event.stiffness_before) / path.events().back().stiffness_after;
    EXPECT_GE(path.changes(event)[0].closes ? jump : -jump, -1e-12);
  }
}

TEST(LcpPath, TorqueControlOnThePathEqualsTheDirectSolve) {
  ContactSolver solver;
  const ContactProblem linear = load_path(read_json(folder + "/load-path.json"));
  const ContactProblem discs = seed_on_discs(read_json(folder + "/load-path.json"),
                                             read_json(folder + "/unit-responses.json"), solver);
  for (const ContactProblem* problem : {&linear, &discs}) {
    const EventPath path = solver.trace(*problem, {.end_torque = 6000.0});
    for (int i = 1; i <= 60; ++i) {
      const double torque = 100.0 * i;
      const auto direct = solver.solve_torque(*problem, torque);
      const ContactState on_path = path.at_torque(torque);
      EXPECT_LT((direct->force - on_path.force).cwiseAbs().maxCoeff(), 1e-12 * direct->force.maxCoeff())
          << torque;
      EXPECT_NEAR(on_path.rotation, direct->rotation, 1e-12 * direct->rotation) << torque;
      EXPECT_NEAR(direct->torque, torque, 1e-12 * torque);
      EXPECT_NEAR(on_path.stiffness, direct->stiffness, 1e-9 * direct->stiffness) << torque;
    }
    EXPECT_NEAR(path.rotation_at(0.0), solver.take_up(*problem).value(), 1e-15);
  }
}

TEST(LcpPath, StiffnessOnATieIsTheOneOfLargerRotation) {
  const ContactProblem problem = ties();
  ContactSolver solver;
  const EventPath path = solver.trace(problem, {.end_rotation = 0.05});
  for (const PathEvent& event : path.events()) {
    const ContactState state = solver.solve_at(problem, event.rotation);
    EXPECT_EQ(state.biactive.size(), 2u);
    EXPECT_NEAR(state.stiffness, event.stiffness_after, 1e-9 * event.stiffness_after);
  }
}

TEST(LcpPath, StartsOnAnEvent) {
  const ContactProblem problem = ties();
  ContactSolver solver;
  const EventPath whole = solver.trace(problem, {.end_rotation = 0.05});
  const double event = whole.events()[5].rotation;
  const EventPath rest = solver.trace(problem, {.start_rotation = event, .end_rotation = 0.05});
  EXPECT_EQ(rest.events().size(), whole.events().size() - 6);
  EXPECT_NEAR(rest.end_torque(), whole.end_torque(), 1e-12 * whole.end_torque());
}

TEST(LcpPath, TwoEqualLobesUnfoldedGiveTheFoldedPath) {
  // Both lobes as unknowns of their own, D split into near and far halves: every event is a pair.
  const ContactProblem one = load_path(read_json(folder + "/load-path.json"));
  const int n = one.size();
  ContactProblem two{Eigen::MatrixXd(2 * n, 2 * n), Eigen::VectorXd(2 * n), Eigen::VectorXd(2 * n)};
  const Eigen::MatrixXd far = 0.2 * one.m;
  two.m << one.m - far, far, far, one.m - far;
  two.q << one.q, one.q;
  two.r << one.r, one.r;
  ContactSolver solver;
  const EventPath folded = solver.trace(one, {.end_rotation = 5e-3});
  const EventPath unfolded = solver.trace(two, {.end_rotation = 5e-3});
  ASSERT_EQ(unfolded.events().size(), folded.events().size());
  for (std::size_t k = 0; k < folded.events().size(); ++k) {
    const auto changes = unfolded.changes(unfolded.events()[k]);
    ASSERT_EQ(changes.size(), 2u);
    EXPECT_EQ(changes[0].index + n, changes[1].index);
    EXPECT_NEAR(unfolded.events()[k].rotation, folded.events()[k].rotation, 1e-15);
  }
  EXPECT_NEAR(unfolded.end_torque(), 2.0 * folded.end_torque(), 1e-11 * unfolded.end_torque());
}

TEST(LcpPath, TwoEqualLobesOnTheDiscsGiveTheFoldedPath) {
  ContactSolver solver;
  const auto loads = read_json(folder + "/load-path.json"),
             responses = read_json(folder + "/unit-responses.json");
  const ContactProblem one = seed_on_discs(loads, responses, solver),
                       two = seed_on_discs(loads, responses, solver, 2);
  const EventPath folded = solver.trace(one, {.end_torque = 3500.0});
  const EventPath unfolded = solver.trace(two, {.end_torque = 7000.0});
  ASSERT_EQ(unfolded.events().size(), folded.events().size());
  // Condition of the closed block about 1e4: events agree to 1e4 ε with room, forces to 1e-12 of the largest.
  const double rounding = 2e-11 * folded.end_rotation();
  for (std::size_t k = 0; k < folded.events().size(); ++k) {
    const PathEvent &a = folded.events()[k], &b = unfolded.events()[k];
    EXPECT_EQ(b.change_count, 2 * a.change_count) << k;
    EXPECT_NEAR(b.rotation, a.rotation, rounding) << k;
    EXPECT_NEAR(b.stiffness_after, 2.0 * a.stiffness_after, 1e-9 * b.stiffness_after) << k;
  }
  EXPECT_NEAR(unfolded.end_rotation(), folded.end_rotation(), rounding);
  const ContactState state = unfolded.at_torque(7000.0), direct = solver.solve_torque(two, 7000.0).value();
  EXPECT_LT((state.force.head(28) - state.force.segment(28, 28)).cwiseAbs().maxCoeff(),
            1e-12 * state.force.maxCoeff());
  EXPECT_LT((state.force - direct.force).cwiseAbs().maxCoeff(), 1e-12 * direct.force.maxCoeff());
}

} // namespace
} // namespace strainwave
