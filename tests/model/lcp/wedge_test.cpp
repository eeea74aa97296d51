// Drive and coast flanks in one problem (r of both signs): free gears with play, wedged gears in balance at
// no torque.

#include "strainwave/model/lcp/march.hpp"
#include "strainwave/model/lcp/path.hpp"
#include "tests/model/lcp/problems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace strainwave {
namespace {

using namespace contact_problems;

/// random_spd with every second of the carrying indices turned into a coast flank; gaps shifted: shift < 0
/// wedges.
ContactProblem both_flanks(int n, unsigned seed, double shift, int supports = 0) {
  ContactProblem p = random_spd(n, n + 2, 0.1, seed, supports);
  for (int i = supports; i < n; ++i) {
    p.q[i] += shift;
    if ((i - supports) % 2 == 1)
      p.r[i] = -p.r[i];
  }
  return p;
}

/// A solution by trying every closed set: forces and rotation of the set with the least violation.
struct Tried {
  Eigen::VectorXd force;
  double rotation = 0.0, violation = 0.0;
};

/// At a torque: M_AA z − θ r_A = −q_A, r_A · z = T on every set (full pivoting), signs judged afterwards.
Tried every_set(const ContactProblem& problem, double torque) {
  const int n = problem.size();
  Tried best{Eigen::VectorXd::Zero(n), 0.0, 1e300};
  for (unsigned mask = 1; mask < (1u << n); ++mask) {
    std::vector<int> set;
    for (int i = 0; i < n; ++i)
      if (mask >> i & 1u)
        set.push_back(i);
    const auto k = static_cast<Eigen::Index>(set.size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(k + 1, k + 1);
    Eigen::VectorXd b(k + 1);
    for (Eigen::Index i = 0; i < k; ++i) {
      for (Eigen::Index j = 0; j < k; ++j)
        a(i, j) = problem.m(set[static_cast<std::size_t>(i)], set[static_cast<std::size_t>(j)]);
      a(i, k) = a(k, i) = -problem.r[set[static_cast<std::size_t>(i)]];
      b(i) = -problem.q[set[static_cast<std::size_t>(i)]];
    }
    b(k) = -torque;
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(a);
    if (!lu.isInvertible())
      continue;
    const Eigen::VectorXd x = lu.solve(b);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < k; ++i)
      force[set[static_cast<std::size_t>(i)]] = x(i);
    Eigen::VectorXd gap = problem.q - x(k) * problem.r + problem.m * force;
    for (const int i : set)
      gap[i] = 0.0;
    const double violation = std::max({0.0, -gap.minCoeff(), -force.minCoeff()});
    if (violation < best.violation)
      best = {force, x(k), violation};
  }
  return best;
}

/// First touches of both sides with the supports in balance alone, by trying every set of supports.
struct Touch {
  double coast = -1e300, drive = 1e300;
};
Touch touches(const ContactProblem& problem, int supports) {
  Eigen::VectorXd best = Eigen::VectorXd::Zero(problem.size());
  double least = 1e300;
  for (unsigned mask = 0; mask < (1u << supports); ++mask) {
    std::vector<int> set;
    for (int i = 0; i < supports; ++i)
      if (mask >> i & 1u)
        set.push_back(i);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(problem.size());
    if (!set.empty()) {
      const Eigen::MatrixXd a = problem.m(set, set);
      const Eigen::VectorXd z = a.fullPivLu().solve(-problem.q(set));
      force(set) = z;
    }
    const Eigen::VectorXd gap = problem.q + problem.m * force;
    const double violation =
        supports == 0 ? 0.0 : std::max(-gap.head(supports).minCoeff(), -force.minCoeff());
    if (violation < least)
      least = violation, best = gap;
  }
  Touch touch;
  for (int i = supports; i < problem.size(); ++i) {
    if (problem.r[i] > 0.0)
      touch.drive = std::min(touch.drive, best[i] / problem.r[i]);
    else
      touch.coast = std::max(touch.coast, best[i] / problem.r[i]);
  }
  return touch;
}

TEST(LcpWedge, TwoFlanksInClosedForm) {
  // One tooth, both flanks overlap by a; own compliance g each, no coupling: F = a/g on both, θ = 0.
  const double a = 5e-3, g = 1e-4, r = 14.5;
  ContactProblem problem{g * Eigen::MatrixXd::Identity(2, 2), Eigen::VectorXd::Constant(2, -a),
                         Eigen::VectorXd::Constant(2, r)};
  problem.r[1] = -r;
  ContactSolver solver;
  const ContactState rest = solver.solve_torque(problem, 0.0).value();
  EXPECT_NEAR(rest.rotation, 0.0, 1e-18);
  EXPECT_NEAR(rest.force[0], a / g, 1e-12);
  EXPECT_NEAR(rest.force[1], a / g, 1e-12);
  EXPECT_NEAR(rest.stiffness, 2.0 * r * r / g, 1e-6);
  EXPECT_TRUE(certify(problem, rest).holds());
  // A torque of 2 r F opens the coast flank: from 2 r a/g on the drive flank carries alone.
  const double opens = 2.0 * r * a / g;
  const ContactState half = solver.solve_torque(problem, 0.5 * opens).value();
  EXPECT_NEAR(half.force[0], 1.5 * a / g, 1e-11);
  EXPECT_NEAR(half.force[1], 0.5 * a / g, 1e-11);
  const ContactState alone = solver.solve_torque(problem, 2.0 * opens).value();
  EXPECT_EQ(alone.force[1], 0.0);
  EXPECT_NEAR(alone.force[0], 2.0 * opens / r, 1e-10);
  const ContactState back = solver.solve_torque(problem, -0.5 * opens).value();
  EXPECT_NEAR(back.rotation, -half.rotation, 1e-18);
  EXPECT_NEAR(back.force[1], half.force[0], 1e-11);
}

TEST(LcpWedge, RandomProblemsAtATorqueEqualEverySetTried) {
  ContactSolver solver;
  int wedged = 0, free = 0;
  for (unsigned seed = 1; seed <= 120; ++seed) {
    const int supports = static_cast<int>(seed % 3), n = 3 + supports + static_cast<int>(seed % 5);
    const ContactProblem problem = both_flanks(n, seed, seed % 2 == 0 ? -0.7 : 1.0, supports);
    const Touch touch = touches(problem, supports);
    (touch.coast > touch.drive ? wedged : free) += 1;
    for (const double torque : {-2.0, -0.05, 0.05, 0.6, 3.0}) {
      const ContactState state = solver.solve_torque(problem, torque).value();
      const Tried expected = every_set(problem, torque);
      ASSERT_LT(expected.violation, 1e-12);
      // Condition ≤ 100, bordered system: some 1e3 ε.
      EXPECT_LT((state.force - expected.force).cwiseAbs().maxCoeff(),
                1e-12 * (1.0 + expected.force.maxCoeff()))
          << seed << " " << torque;
      EXPECT_NEAR(state.rotation, expected.rotation, 1e-12) << seed << " " << torque;
      EXPECT_TRUE(certify(problem, state).holds(1e-12)) << seed << " " << torque;
    }
    const ContactState rest = solver.solve_torque(problem, 0.0).value();
    EXPECT_TRUE(certify(problem, rest).holds(1e-12)) << seed;
    EXPECT_EQ(rest.torque, 0.0);
    EXPECT_NEAR(solver.take_up(problem).value(), rest.rotation, 1e-13) << seed;
    if (touch.coast > touch.drive) {
      const Tried expected = every_set(problem, 0.0);
      EXPECT_LT((rest.force - expected.force).cwiseAbs().maxCoeff(),
                1e-12 * (1.0 + expected.force.maxCoeff()))
          << seed;
      EXPECT_NEAR(rest.rotation, expected.rotation, 1e-12) << seed;
      EXPECT_GT(rest.force.tail(n - supports).maxCoeff(), 0.0);
    } else {
      EXPECT_NEAR(rest.rotation, touch.drive, 1e-13) << seed;
      EXPECT_EQ(rest.force.tail(n - supports).maxCoeff(), 0.0) << seed;
    }
  }
  EXPECT_GT(wedged, 30);
  EXPECT_GT(free, 10);
}

TEST(LcpWedge, SearchOfTheRotationIsTakenAndRight) {
  // Nearly of rank two, where block steps at a torque go astray.
  ContactSolver solver;
  int fallbacks = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    ContactProblem problem = random_spd(6, 2, 1e-3, 3000 + seed);
    for (int i = 0; i < 6; ++i) {
      problem.q[i] -= 0.8;
      if (i % 2 == 1)
        problem.r[i] = -problem.r[i];
    }
    for (const double torque : {-1.0, 0.0, 1.0}) {
      if (torque == 0.0 && !(touches(problem, 0).coast > touches(problem, 0).drive))
        continue;
      const ContactState state = solver.solve_torque(problem, torque).value();
      fallbacks += state.fallback;
      const Tried expected = every_set(problem, torque);
      // Condition about 1e4 in M and again in the bordered system.
      EXPECT_LT((state.force - expected.force).cwiseAbs().maxCoeff(),
                1e-9 * (1.0 + expected.force.maxCoeff()))
          << seed << " " << torque;
      EXPECT_TRUE(certify(problem, state).holds(1e-9)) << seed << " " << torque;
    }
  }
  EXPECT_GE(fallbacks, 1);
}

TEST(LcpWedge, TheFirstGuessDoesNotChangeABit) {
  ContactSolver solver;
  std::mt19937_64 engine(7);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ContactProblem problem = both_flanks(12, 40 + seed, -0.4, 3);
    for (const double torque : {-0.3, 0.0, 0.3}) {
      const ContactState cold = solver.solve_torque(problem, torque).value();
      for (int guess = 0; guess < 20; ++guess) {
        ActiveSet warm(12);
        for (auto& w : warm)
          w = engine() % 2;
        const ContactState other = solver.solve_torque(problem, torque, warm).value();
        EXPECT_TRUE(other.force == cold.force && other.rotation == cold.rotation && other.gap == cold.gap)
            << seed << " " << torque;
      }
    }
  }
}

TEST(LcpWedge, TorqueNeverFallsAndThePathEqualsDirectSolves) {
  ContactSolver solver;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const ContactProblem problem =
        both_flanks(4 + static_cast<int>(seed % 14), 200 + seed, seed % 3 == 0 ? 0.8 : -0.5, 2);
    const EventPath path = solver.trace(problem, {.start_rotation = -3.0, .end_rotation = 3.0});
    ASSERT_EQ(path.end(), EventPath::End::rotation);
    EXPECT_LT(path.start_torque(), 0.0);
    double before = -1e300;
    for (int i = 0; i <= 120; ++i) {
      const double rotation = (i - 60) / 20.0;
      const ContactState direct = solver.solve_at(problem, rotation);
      EXPECT_GE(direct.torque, before - 1e-12 * std::abs(before));
      before = direct.torque;
      EXPECT_LT((path.at(rotation).force - direct.force).cwiseAbs().maxCoeff(),
                1e-12 * std::max(1.0, direct.force.maxCoeff()))
          << seed << " " << rotation;
      EXPECT_NEAR(path.torque_at(rotation), direct.torque, 1e-11 * std::max(1.0, direct.force.maxCoeff()));
    }
    const ContactState loaded = solver.solve_torque(problem, 1.0).value();
    EXPECT_NEAR(path.rotation_at(1.0), loaded.rotation, 1e-12) << seed;
  }
}

TEST(LcpWedge, MarchingEndsOnTheDirectSolution) {
  ContactSolver solver;
  const ContactProblem problem = both_flanks(10, 5, -0.5, 2);
  const March way = march(problem, -1.0, 1.0, {.step = 1e-2, .least_step = 1e-5}, solver);
  const ContactState direct = solver.solve_at(problem, 1.0);
  EXPECT_LT((way.last.force - direct.force).cwiseAbs().maxCoeff(), 1e-12 * direct.force.maxCoeff());
  EXPECT_LT(way.torque.front(), 0.0);
}

TEST(LcpWedge, CertificateFindsAPoisonedCoastForce) {
  ContactSolver solver;
  const ContactProblem problem = both_flanks(8, 3, -0.7, 2);
  const ContactState rest = solver.solve_torque(problem, 0.0).value();
  ASSERT_TRUE(certify(problem, rest).holds());
  for (int i = 2; i < 8; ++i) {
    if (!(problem.r[i] < 0.0) || !rest.active[static_cast<std::size_t>(i)])
      continue;
    ContactState poisoned = rest;
    poisoned.force[i] *= 1.0 + 1e-6;
    EXPECT_FALSE(certify(problem, poisoned).holds()) << i;
  }
}

} // namespace
} // namespace strainwave
