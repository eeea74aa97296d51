// Small and odd problems, wrong input, and the certificate.

#include "strainwave/model/lcp/path.hpp"
#include "tests/model/lcp/problems.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace strainwave {
namespace {

using namespace contact_problems;

ContactProblem single() { // the worked example of solver.hpp
  return {Eigen::MatrixXd::Constant(1, 1, 1e-4), Eigen::VectorXd::Constant(1, 4e-3),
          Eigen::VectorXd::Constant(1, 14.5)};
}

TEST(LcpEdge, EmptyProblemHasAnEmptySolution) {
  const ContactProblem problem{Eigen::MatrixXd(0, 0), Eigen::VectorXd(0), Eigen::VectorXd(0)};
  ContactSolver solver;
  const ContactState state = solver.solve_at(problem, 1e-3);
  EXPECT_EQ(state.force.size(), 0);
  EXPECT_EQ(state.torque, 0.0);
  EXPECT_FALSE(state.contact);
  EXPECT_TRUE(certify(problem, state).holds());
  EXPECT_EQ(solver.solve_torque(problem, 1.0).failure().status, Status::no_contact);
  const EventPath path = solver.trace(problem, {.end_torque = 10.0});
  EXPECT_EQ(path.end(), EventPath::End::no_contact);
  EXPECT_EQ(path.torque_at(1.0), 0.0);
}

TEST(LcpEdge, OneIndexInClosedForm) {
  const ContactProblem problem = single();
  ContactSolver solver;
  const ContactState state = solver.solve_at(problem, 1e-3);
  EXPECT_NEAR(state.force[0], 105.0, 1e-11); // (14.5e-3 − 4e-3) / 1e-4
  EXPECT_NEAR(state.torque, 105.0 * 14.5, 1e-9);
  EXPECT_NEAR(state.stiffness, 14.5 * 14.5 / 1e-4, 1e-6);
  const auto at_torque = solver.solve_torque(problem, 105.0 * 14.5);
  EXPECT_NEAR(at_torque->rotation, 1e-3, 1e-17);
  const EventPath path = solver.trace(problem, {.end_rotation = 1e-3});
  ASSERT_EQ(path.events().size(), 1u);
  EXPECT_NEAR(path.events()[0].rotation, 4e-3 / 14.5, 1e-18);
  EXPECT_EQ(path.events()[0].stiffness_before, 0.0);
  EXPECT_NEAR(path.events()[0].stiffness_after, 14.5 * 14.5 / 1e-4, 1e-6);
}

TEST(LcpEdge, NoContactInRangeIsAResultThatSaysSo) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  ContactSolver solver;
  const ContactState state = solver.solve_at(problem, 1e-4);
  EXPECT_FALSE(state.contact);
  EXPECT_EQ(state.torque, 0.0);
  EXPECT_EQ(state.stiffness, 0.0);
  EXPECT_EQ(state.force.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(state.gap.minCoeff(), 0.0);
  const EventPath path = solver.trace(problem, {.end_rotation = 2e-4});
  EXPECT_EQ(path.end(), EventPath::End::rotation);
  EXPECT_FALSE(path.contact());
  EXPECT_TRUE(path.events().empty());
  EXPECT_FALSE(path.at(2e-4).contact);
}

TEST(LcpEdge, TorqueOnSupportsAloneIsNoContact) {
  ContactProblem problem = single();
  problem.r.setZero();
  ContactSolver solver;
  EXPECT_EQ(solver.solve_torque(problem, 1.0).failure().status, Status::no_contact);
  EXPECT_EQ(solver.take_up(problem).failure().status, Status::no_contact);
  EXPECT_EQ(solver.trace(problem, {.end_torque = 1.0}).end(), EventPath::End::no_contact);
}

TEST(LcpEdge, TakeUpIsTheLeastGapOverRadius) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  ContactSolver solver;
  const double expected = (problem.q.array() / problem.r.array()).minCoeff();
  EXPECT_DOUBLE_EQ(solver.take_up(problem).value(), expected);
  const auto state = solver.solve_torque(problem, 0.0);
  EXPECT_DOUBLE_EQ(state->rotation, expected);
  EXPECT_TRUE(state->contact);
  ASSERT_EQ(state->biactive.size(), 1u);
  EXPECT_EQ(state->torque, 0.0);
  const int tooth = state->biactive[0];
  EXPECT_NEAR(state->stiffness, problem.r[tooth] * problem.r[tooth] / problem.m(tooth, tooth), 1e-6);
}

TEST(LcpEdge, TakeUpOnThePreloadedDiscsCarriesNoToothForce) {
  ContactSolver solver;
  const auto reference = read_json(folder + "/load-path.json");
  const ContactProblem problem = seed_on_discs(reference, read_json(folder + "/unit-responses.json"), solver);
  const auto state = solver.solve_torque(problem, 0.0);
  // On the unloaded discs the teeth's gaps are the backlash: take-up as without discs.
  const double expected =
      (vector_of(reference["backlash_mm"]).array() / problem.r.head(28).array()).minCoeff();
  EXPECT_NEAR(state->rotation, expected, 1e-15);
  EXPECT_EQ(state->force.head(28).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(state->force.tail(420).sum(), 10.0); // N, preload of the discs
  EXPECT_GT(state->stiffness, 0.0);
  EXPECT_TRUE(certify(problem, *state).holds());
}

TEST(LcpEdge, WrongInputIsRefused) {
  ContactSolver solver;
  ContactProblem problem = single();
  EXPECT_THROW((void)solver.solve_torque(problem, -1.0), std::invalid_argument);
  EXPECT_THROW((void)solver.solve_torque(problem, std::nan("")), std::invalid_argument);
  EXPECT_THROW((void)solver.solve_at(problem, std::nan("")), std::invalid_argument);
  EXPECT_THROW((void)solver.solve_at(problem, 0.0, ActiveSet(3, 1)), std::invalid_argument);
  EXPECT_THROW((void)solver.trace(problem, {.start_rotation = 1.0, .end_rotation = 0.0}),
               std::invalid_argument);
  problem.q[0] = std::nan("");
  EXPECT_THROW((void)solver.solve_at(problem, 0.0), std::invalid_argument);
  problem = single();
  problem.r.resize(2);
  EXPECT_THROW((void)solver.solve_at(problem, 0.0), std::invalid_argument);
}

TEST(LcpEdge, IndefiniteOrUndefinedMatrixNamesTheIndex) {
  ContactSolver solver;
  ContactProblem problem{Eigen::MatrixXd::Identity(3, 3), Eigen::VectorXd::Constant(3, -1.0),
                         Eigen::VectorXd::Ones(3)};
  problem.m(2, 2) = -1.0;
  try {
    (void)solver.solve_at(problem, 0.0);
    FAIL() << "an indefinite matrix was accepted";
  } catch (const NotPositiveDefinite& e) {
    EXPECT_EQ(e.index, 2);
    EXPECT_EQ(e.pivot, -1.0);
  }
  problem.m(2, 2) = 1.0;
  problem.m(1, 0) = problem.m(0, 1) = std::nan("");
  EXPECT_THROW((void)solver.solve_at(problem, 0.0), NotPositiveDefinite);
}

TEST(LcpEdge, OutsideThePathIsRefused) {
  ContactSolver solver;
  const EventPath path = solver.trace(single(), {.end_rotation = 1e-3});
  EXPECT_THROW((void)path.at(1.1e-3), std::out_of_range);
  EXPECT_THROW((void)path.at(-1e-9), std::out_of_range);
  EXPECT_THROW((void)path.at_torque(1e6), std::out_of_range);
}

TEST(LcpEdge, CertificateFindsOnePoisonedForce) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  ContactSolver solver;
  const ContactState good = solver.solve_at(problem, 3e-3);
  ASSERT_TRUE(certify(problem, good).holds());
  Eigen::Index loaded = 0, open = 0;
  good.force.maxCoeff(&loaded);
  good.gap.maxCoeff(&open);
  ContactState poisoned = good;
  poisoned.force[loaded] *= 1.0 + 1e-6;
  EXPECT_FALSE(certify(problem, poisoned).holds());
  poisoned = good;
  poisoned.force[open] = -1e-3;
  EXPECT_FALSE(certify(problem, poisoned).holds());
  EXPECT_EQ(certify(problem, poisoned).min_force, -1e-3);
  poisoned.force[open] = 1e-3;
  EXPECT_FALSE(certify(problem, poisoned).holds());
  EXPECT_EQ(certify(problem, poisoned).worst, static_cast<int>(open));
  poisoned = good;
  poisoned.torque *= 1.0 + 1e-9;
  EXPECT_FALSE(certify(problem, poisoned).holds());
  poisoned = good;
  poisoned.force[loaded] = std::nan("");
  EXPECT_FALSE(certify(problem, poisoned).holds());
}

} // namespace
} // namespace strainwave
