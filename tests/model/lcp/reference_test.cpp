// The solver against numbers of other programs: the seed gear's loaded states, matrices on which plain active
// sets cycle, Fathi's matrix.

#include "tests/model/lcp/problems.hpp"

#include <gtest/gtest.h>

#include <set>

namespace strainwave {
namespace {

using namespace contact_problems;

TEST(LcpReference, ForcesAtGivenRotationsOfTheSeedGear) {
  const auto reference = read_json(folder + "/load-path.json");
  const ContactProblem problem = load_path(reference);
  ContactSolver solver;
  for (const auto& c : reference["rotation_cases"]) {
    const ContactState state = solver.solve_at(problem, c["rotation_rad"].get<double>());
    EXPECT_LT((state.force - vector_of(c["force_n"])).cwiseAbs().maxCoeff(), 1e-8) << c["rotation_rad"];
    // Gaps: 1e-8 N times the largest compliance, 28 times.
    EXPECT_LT((state.gap - vector_of(c["gap_mm"])).cwiseAbs().maxCoeff(), 1e-12) << c["rotation_rad"];
    // The reference counts both lobes, N·m.
    EXPECT_NEAR(2e-3 * state.torque, c["torque_nm"].get<double>(), 1e-9) << c["rotation_rad"];
    EXPECT_TRUE(certify(problem, state).holds());
  }
}

TEST(LcpReference, RotationsAndForcesAtGivenTorquesOfTheSeedGear) {
  const auto reference = read_json(folder + "/load-path.json");
  const ContactProblem problem = load_path(reference);
  ContactSolver solver;
  for (const auto& c : reference["torque_cases"]) {
    const auto state = solver.solve_torque(problem, 500.0 * c["torque_nm"].get<double>());
    ASSERT_TRUE(state.ok());
    EXPECT_LT((state->force - vector_of(c["force_n"])).cwiseAbs().maxCoeff(), 1e-8) << c["torque_nm"];
    EXPECT_NEAR(state->rotation, c["rotation_rad"].get<double>(), 1e-13) << c["torque_nm"];
    EXPECT_NEAR(state->force.maxCoeff(), c["peak_force_n"].get<double>(), 1e-8);
    EXPECT_TRUE(certify(problem, *state).holds());
  }
}

/// The textbook method alone: true when a set comes back.
bool plain_active_set_cycles(const ContactProblem& problem) {
  const int n = problem.size();
  std::set<std::vector<bool>> seen;
  std::vector<bool> closed(static_cast<std::size_t>(n), false);
  while (seen.insert(closed).second) {
    std::vector<int> a;
    for (int i = 0; i < n; ++i)
      if (closed[static_cast<std::size_t>(i)])
        a.push_back(i);
    const Eigen::VectorXd x = Eigen::MatrixXd(problem.m(a, a)).ldlt().solve(-problem.q(a));
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
    z(a) = x;
    const Eigen::VectorXd gap = problem.q + problem.m * z;
    std::vector<bool> next = closed;
    for (int i = 0; i < n; ++i)
      next[static_cast<std::size_t>(i)] = closed[static_cast<std::size_t>(i)] ? z[i] > 0.0 : gap[i] < 0.0;
    if (next == closed)
      return false;
    closed = next;
  }
  return true;
}

TEST(LcpReference, AnswersWherePlainActiveSetsCycle) {
  const auto reference = read_json(folder + "/benchmarks.json");
  ASSERT_EQ(reference["lcp_cycle"].size(), 2u);
  ContactSolver solver;
  for (const auto& c : reference["lcp_cycle"]) {
    const ContactProblem problem{matrix_of(c["M"]), vector_of(c["q"]), Eigen::VectorXd::Zero(3)};
    EXPECT_TRUE(plain_active_set_cycles(problem));
    const ContactState state = solver.solve_at(problem, 0.0);
    EXPECT_TRUE(state.fallback);
    // Condition numbers 1e2 to 1e3: 1e-13.
    EXPECT_LT((state.force - vector_of(c["F"])).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(LcpReference, FathisMatrix) {
  ContactSolver solver;
  for (const int n : {5, 10, 28, 56, 100, 140}) {
    const ContactProblem problem = fathi(n);
    const ContactState state = solver.solve_at(problem, 0.0);
    EXPECT_LT((state.force - Eigen::VectorXd::Unit(n, 0)).cwiseAbs().maxCoeff(), 1e-12) << n;
    const ContactState warm = solver.solve_at(problem, 0.0, ActiveSet(static_cast<std::size_t>(n), 1));
    EXPECT_EQ(warm.force, state.force) << n;
  }
}

} // namespace
} // namespace strainwave
