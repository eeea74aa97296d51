// Families of random problems against independent methods; independence of the first guess.

#include "strainwave/model/lcp/path.hpp"
#include "tests/model/lcp/problems.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace strainwave {
namespace {

using namespace contact_problems;

/// Elimination without pivoting in long double: a is k × k by rows, b becomes the solution.
void eliminate(std::vector<long double>& a, std::vector<long double>& b) {
  const std::size_t k = b.size();
  for (std::size_t p = 0; p < k; ++p)
    for (std::size_t row = p + 1; row < k; ++row) {
      const long double factor = a[row * k + p] / a[p * k + p];
      for (std::size_t c = p; c < k; ++c)
        a[row * k + c] -= factor * a[p * k + c];
      b[row] -= factor * b[p];
    }
  for (std::size_t p = k; p-- > 0;) {
    for (std::size_t c = p + 1; c < k; ++c)
      b[p] -= a[p * k + c] * b[c];
    b[p] /= a[p * k + p];
  }
}

/// Tries every closed set and takes the one whose worst sign violation is least.
Eigen::VectorXd brute_force(const ContactProblem& problem, double rotation) {
  const int n = problem.size();
  Eigen::VectorXd best = Eigen::VectorXd::Zero(n);
  long double least = std::numeric_limits<long double>::infinity();
  for (unsigned mask = 0; mask < (1u << n); ++mask) {
    std::vector<int> set;
    for (int i = 0; i < n; ++i)
      if (mask >> i & 1u)
        set.push_back(i);
    std::vector<long double> a, z;
    for (const int i : set) {
      for (const int j : set)
        a.push_back(problem.m(i, j));
      z.push_back(static_cast<long double>(rotation) * problem.r[i] - problem.q[i]);
    }
    eliminate(a, z);
    long double worst = 0.0;
    for (const long double force : z)
      worst = std::max(worst, -force);
    for (int i = 0; i < n; ++i) {
      if (mask >> i & 1u)
        continue;
      long double gap = problem.q[i] - static_cast<long double>(rotation) * problem.r[i];
      for (std::size_t p = 0; p < set.size(); ++p)
        gap += static_cast<long double>(problem.m(i, set[p])) * z[p];
      worst = std::max(worst, -gap);
    }
    if (worst >= least)
      continue;
    least = worst;
    best.setZero();
    for (std::size_t p = 0; p < set.size(); ++p)
      best[set[p]] = static_cast<double>(z[p]);
  }
  return best;
}

Eigen::VectorXd projected_gauss_seidel(const ContactProblem& problem, double rotation, int sweeps) {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(problem.size());
  const Eigen::VectorXd b = problem.q - rotation * problem.r;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (int i = 0; i < problem.size(); ++i)
      z[i] = std::max(0.0, z[i] - (b[i] + problem.m.row(i).dot(z)) / problem.m(i, i));
  return z;
}

TEST(LcpRandom, WellConditionedEqualsEverySetTried) {
  ContactSolver solver;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const int n = 1 + static_cast<int>(seed % 9);
    const ContactProblem problem = random_spd(n, n + 2, 0.1, seed, n / 3);
    const double rotation = -1.0 + 0.05 * seed;
    const ContactState state = solver.solve_at(problem, rotation);
    const Eigen::VectorXd expected = brute_force(problem, rotation);
    // Condition ≤ 50: 50 ε times n, with room.
    EXPECT_LT((state.force - expected).cwiseAbs().maxCoeff(), 1e-13 * std::max(1.0, expected.maxCoeff()))
        << seed;
    EXPECT_TRUE(certify(problem, state).holds(1e-13)) << seed;
  }
}

TEST(LcpRandom, NearlyRankTwoEqualsEverySetTried) {
  ContactSolver solver;
  int fallbacks = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    const ContactProblem problem = random_spd(5, 2, 1e-6, seed);
    const ContactState state = solver.solve_at(problem, 0.0);
    fallbacks += state.fallback;
    const Eigen::VectorXd expected = brute_force(problem, 0.0);
    // Condition about 1e6, ε × condition = 2e-10; forces up to |q| / 1e-6.
    EXPECT_LT((state.force - expected).cwiseAbs().maxCoeff(), 2e-9 * std::max(1.0, expected.maxCoeff()))
        << seed;
    EXPECT_GE(state.force.minCoeff(), 0.0);
  }
  EXPECT_GE(fallbacks, 1); // plain active sets cycle in 1.7 % of such cases
}

TEST(LcpRandom, EqualsProjectedGaussSeidel) {
  ContactSolver solver;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const ContactProblem problem = random_spd(40, 60, 0.2, seed, 10);
    const ContactState state = solver.solve_at(problem, 0.7);
    const Eigen::VectorXd expected = projected_gauss_seidel(problem, 0.7, 4000);
    EXPECT_LT((state.force - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.maxCoeff()) << seed;
  }
}

bool same_bits(const ContactState& a, const ContactState& b) {
  return a.active == b.active && a.biactive == b.biactive && a.force == b.force && a.gap == b.gap &&
         std::memcmp(&a.torque, &b.torque, sizeof(double)) == 0 &&
         std::memcmp(&a.rotation, &b.rotation, sizeof(double)) == 0 &&
         std::memcmp(&a.stiffness, &b.stiffness, sizeof(double)) == 0;
}

void expect_independent_of_the_guess(const ContactProblem& problem, const std::vector<double>& rotations,
                                     unsigned seed, int guesses) {
  std::mt19937_64 engine(seed);
  ContactSolver solver;
  for (const double rotation : rotations) {
    const ContactState cold = solver.solve_at(problem, rotation);
    const auto cold_torque =
        cold.torque > 0.0 ? solver.solve_torque(problem, cold.torque) : solver.solve_torque(problem, 0.0);
    for (int guess = 0; guess < guesses; ++guess) {
      ActiveSet warm(static_cast<std::size_t>(problem.size()));
      for (auto& w : warm)
        w = engine() % 3 == 0;
      EXPECT_TRUE(same_bits(solver.solve_at(problem, rotation, warm), cold)) << rotation;
      if (cold.torque > 0.0) {
        EXPECT_TRUE(same_bits(solver.solve_torque(problem, cold.torque, warm).value(), *cold_torque))
            << rotation;
      }
    }
  }
}

TEST(LcpRandom, TheFirstGuessDoesNotChangeABit) {
  expect_independent_of_the_guess(load_path(read_json(folder + "/load-path.json")),
                                  {2e-4, 1e-3, 3.1e-3, 5e-3}, 1, 50);
  expect_independent_of_the_guess(smooth(140), {1e-3, 4e-3}, 2, 10);
}

TEST(LcpRandom, TheFirstGuessDoesNotChangeABitOnAnEvent) {
  const ContactProblem seed = load_path(read_json(folder + "/load-path.json")), pairs = ties();
  ContactSolver solver;
  for (const ContactProblem* problem : {&seed, &pairs}) {
    const EventPath path = solver.trace(*problem, {.end_rotation = 0.05});
    std::vector<double> rotations;
    for (const PathEvent& event : path.events())
      rotations.push_back(event.rotation);
    ASSERT_GE(rotations.size(), 10u);
    expect_independent_of_the_guess(*problem, rotations, 3, 20);
  }
}

TEST(LcpRandom, TheFirstGuessDoesNotChangeABitWithTheDiscs) {
  ContactSolver solver;
  const ContactProblem problem = seed_on_discs(read_json(folder + "/load-path.json"),
                                               read_json(folder + "/unit-responses.json"), solver);
  expect_independent_of_the_guess(problem, {0.0, 1.5e-3, 4e-3}, 4, 5);
}

TEST(LcpRandom, PathEqualsDirectSolvesAcrossFamilies) {
  ContactSolver solver;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const int n = 3 + static_cast<int>(seed % 20);
    const ContactProblem problem = random_spd(n, n, 0.05, 100 + seed, n / 2);
    const EventPath path = solver.trace(problem, {.start_rotation = -3.0, .end_rotation = 5.0});
    ASSERT_EQ(path.end(), EventPath::End::rotation);
    for (int i = 0; i <= 100; ++i) {
      const double rotation = -3.0 + 0.08 * i;
      const ContactState direct = solver.solve_at(problem, rotation);
      // Condition up to some 1e2.
      EXPECT_LT((path.at(rotation).force - direct.force).cwiseAbs().maxCoeff(),
                1e-12 * std::max(1.0, direct.force.maxCoeff()))
          << seed << " " << rotation;
    }
  }
}

/// Copies of one random problem, coupled alike: every event concerns all copies at once. Small whole numbers
/// for gaps make further events coincide; the last `idle` indices are decoupled supports at rest (force and
/// gap zero for every θ).
ContactProblem many_ties(int n, int copies, int idle, unsigned seed) {
  const ContactProblem one = random_spd(n, n + 1, 0.1, seed, n / 4);
  const int total = n * copies + idle;
  ContactProblem p{Eigen::MatrixXd::Zero(total, total), Eigen::VectorXd::Zero(total),
                   Eigen::VectorXd::Zero(total)};
  for (int a = 0; a < copies; ++a) {
    for (int b = 0; b < copies; ++b)
      p.m.block(a * n, b * n, n, n) = (a == b ? 1.0 : 0.25) * one.m;
    for (int i = 0; i < n; ++i) {
      p.q[a * n + i] = static_cast<double>((7 * i + static_cast<int>(seed)) % 4);
      p.r[a * n + i] = one.r[i] > 0.0 ? 1.0 : 0.0;
    }
  }
  for (int i = n * copies; i < total; ++i)
    p.m(i, i) = 1.0;
  return p;
}

TEST(LcpRandom, PathsThroughManyTiesEqualDirectSolves) {
  ContactSolver solver;
  for (unsigned seed = 1; seed <= 80; ++seed) {
    const int n = 2 + static_cast<int>(seed % 7), copies = 1 + static_cast<int>(seed % 5),
              idle = static_cast<int>(seed % 3);
    const ContactProblem problem = many_ties(n, copies, idle, seed);
    const EventPath path = solver.trace(problem, {.start_rotation = -0.5, .end_rotation = 9.5});
    ASSERT_EQ(path.end(), EventPath::End::rotation) << seed;
    for (const PathEvent& event : path.events())
      EXPECT_EQ(event.change_count % copies, 0) << seed;
    for (int i = 0; i <= 200; ++i) { // every fourth lies on a whole number, where gaps close
      const double rotation = -0.5 + 0.05 * i;
      const ContactState direct = solver.solve_at(problem, rotation), on_path = path.at(rotation);
      EXPECT_LT((on_path.force - direct.force).cwiseAbs().maxCoeff(),
                1e-12 * std::max(1.0, direct.force.maxCoeff()))
          << seed << " " << rotation;
      EXPECT_TRUE(certify(problem, on_path).holds(1e-12)) << seed << " " << rotation;
      if (static_cast<int>(direct.biactive.size()) > idle)
        continue; // on an event the slope depends on the last bit
      EXPECT_NEAR(on_path.stiffness, direct.stiffness, 1e-9 * std::max(1.0, direct.stiffness))
          << seed << " " << rotation;
    }
  }
}

TEST(LcpRandom, NearlyRankTwoPathsHoldTheirCertificate) {
  ContactSolver solver;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const ContactProblem problem = random_spd(8, 2, 1e-6, 500 + seed, 3);
    const EventPath path = solver.trace(problem, {.start_rotation = -2.0, .end_rotation = 2.0});
    ASSERT_EQ(path.end(), EventPath::End::rotation) << seed;
    for (int i = 0; i <= 40; ++i) {
      const double rotation = -2.0 + 0.1 * i;
      const ContactState direct = solver.solve_at(problem, rotation), on_path = path.at(rotation);
      EXPECT_TRUE(certify(problem, on_path).holds(1e-9)) << seed << " " << rotation;
      EXPECT_LT((on_path.force - direct.force).cwiseAbs().maxCoeff(),
                1e-8 * std::max(1.0, direct.force.maxCoeff()))
          << seed;
    }
  }
}

} // namespace
} // namespace strainwave
