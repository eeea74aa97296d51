// Adjoint derivatives against central differences, with the order measured.

#include "strainwave/model/lcp/derivative.hpp"
#include "tests/model/lcp/problems.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

using namespace contact_problems;

/// A direction in which M, q, r and the control move together.
struct Direction {
  Eigen::MatrixXd m;
  Eigen::VectorXd q, r;
  double control = 0.0;
};

Direction direction_for(const ContactProblem& p, double control_scale) {
  const int n = p.size();
  const ContactProblem a = random_spd(n, n, 0.0, 77), b = random_spd(n, n, 0.0, 78);
  Direction d;
  d.m = 0.3 * p.m.diagonal().mean() * (a.m - b.m);
  d.q = 0.3 * p.q.cwiseAbs().mean() * a.q;
  d.r = 0.1 * (a.r - b.r).cwiseProduct(p.r);
  d.control = 0.2 * control_scale;
  return d;
}

void expect_second_order(const ContactProblem& problem, double control, ContactSensitivity::Held held,
                         const ContactFunctional& functional) {
  ContactSolver solver;
  const auto solve = [&](const ContactProblem& p, double c) {
    return held == ContactSensitivity::Held::rotation ? solver.solve_at(p, c)
                                                      : solver.solve_torque(p, c).value();
  };
  const Direction direction = direction_for(problem, control);
  const ContactState state = solve(problem, control);
  const auto value = [&](double t) {
    const ContactProblem p{problem.m + t * direction.m, problem.q + t * direction.q,
                           problem.r + t * direction.r};
    const ContactState s = solve(p, control + t * direction.control);
    EXPECT_EQ(s.active, state.active) << "the step crosses an event: t = " << t;
    double j = functional.rotation * s.rotation;
    if (functional.force.size())
      j += functional.force.dot(s.force);
    if (functional.gap.size())
      j += functional.gap.dot(s.gap);
    return j;
  };
  const ContactDerivative d = ContactSensitivity(problem, state, held).of(functional);
  EXPECT_TRUE(d.biactive.empty());
  double expected = d.gap.dot(direction.q) + d.radius.dot(direction.r) + d.control * direction.control;
  for (int i = 0; i < problem.size(); ++i)
    for (int j = 0; j < problem.size(); ++j)
      expected += d.matrix(i, j) * direction.m(i, j);
  double before = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double t = 4e-3 * std::pow(0.5, k);
    const double error = std::abs((value(t) - value(-t)) / (2.0 * t) - expected);
    std::printf("    t = %.2e  error %.3e  order %.3f\n", t, error, k ? std::log2(before / error) : 0.0);
    if (k > 0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.1);
    }
    before = error;
  }
  EXPECT_LT(before, 1e-4 * std::abs(expected));
}

TEST(LcpDerivative, SecondOrderOnTheSeedGearAtARotation) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  const Eigen::VectorXd weight = random_spd(28, 28, 0.0, 5).q, gap = random_spd(28, 28, 0.0, 6).q * 1e4;
  expect_second_order(problem, 2.9e-3, ContactSensitivity::Held::rotation,
                      {.force = weight, .gap = gap, .rotation = 2e4});
}

TEST(LcpDerivative, SecondOrderOnTheSeedGearAtATorque) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  const Eigen::VectorXd weight = random_spd(28, 28, 0.0, 5).q, gap = random_spd(28, 28, 0.0, 6).q * 1e4;
  expect_second_order(problem, 3500.0, ContactSensitivity::Held::torque,
                      {.force = weight, .gap = gap, .rotation = 2e4});
}

TEST(LcpDerivative, SecondOrderWithSupports) {
  const ContactProblem problem = random_spd(30, 40, 0.3, 9, 12);
  const Eigen::VectorXd weight = random_spd(30, 30, 0.0, 15).q;
  expect_second_order(problem, 0.9, ContactSensitivity::Held::rotation,
                      {.force = weight, .gap = {}, .rotation = 0.0});
  expect_second_order(problem, 4.0, ContactSensitivity::Held::torque,
                      {.force = weight, .gap = weight, .rotation = 1.0});
}

TEST(LcpDerivative, TorqueByRotationIsTheTangentStiffness) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  ContactSolver solver;
  const ContactState state = solver.solve_at(problem, 3e-3);
  const ContactDerivative d = ContactSensitivity(problem, state, ContactSensitivity::Held::rotation)
                                  .of({.force = problem.r, .gap = {}, .rotation = 0.0});
  EXPECT_NEAR(d.control, state.stiffness, 1e-12 * state.stiffness);
  const ContactDerivative inverse = ContactSensitivity(problem, state, ContactSensitivity::Held::torque)
                                        .of({.force = {}, .gap = {}, .rotation = 1.0});
  EXPECT_NEAR(inverse.control, 1.0 / state.stiffness, 1e-12 / state.stiffness);
}

TEST(LcpDerivative, BiactiveIndicesAreNamed) {
  const ContactProblem problem = load_path(read_json(folder + "/load-path.json"));
  ContactSolver solver;
  const auto state = solver.solve_torque(problem, 0.0);
  const ContactSensitivity sensitivity(problem, *state, ContactSensitivity::Held::rotation);
  EXPECT_EQ(sensitivity.of({.force = problem.r, .gap = {}, .rotation = 0.0}).biactive, state->biactive);
  EXPECT_EQ(state->biactive.size(), 1u);
  EXPECT_THROW(ContactSensitivity(problem, *state, ContactSensitivity::Held::torque), std::invalid_argument);
}

} // namespace
} // namespace strainwave
