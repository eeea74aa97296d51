// Section by section what an independent program found on the same unit responses: physics of the seed gear,
// one contact point per tooth at tip height, backlash of the exact two-disc curve, linearised disc gap.

#include "strainwave/model/contact/load_problem.hpp"
#include "strainwave/model/contact/tangent_compliance.hpp"

#include "tests/model/contact/reference_cup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace strainwave {
namespace {

using testing_support::reference;
using testing_support::reference_cup;

class SeedGearOnReferenceCup : public ::testing::Test {
protected:
  SeedGearOnReferenceCup()
      : cup(reference_cup()), ring(cup, {22.5, 24.5, 26.5}, true),
        surface({.eccentricity_mm = 0.6, .neutral_disc_radius_mm = 13.606, .linearised = true}, 13.856, 0.15),
        assembled(assemble(ring, surface, 0.0, solver).value()) {
    const auto json = reference("load-path.json");
    for (std::size_t i = 0; i < json["tooth"].size(); ++i) {
      const int tooth = json["tooth"][i];
      teeth.push_back({.tooth = tooth,
                       .phi_rad = 2 * std::numbers::pi * tooth / 140,
                       .backlash_mm = json["backlash_mm"][i],
                       .contact_radius_mm = json["contact_radius_mm"][i],
                       .flank_radius_mm = 14.584});
    }
    // the reference loads every tooth at its tip
    for (const LoadedPoint& tooth : teeth)
      at_tip.push_back(ring.tooth(tooth.tooth, 14.584, 1.0, 0.0));
  }

  UnitResponses cup;
  RingCompliance ring;
  WaveGeneratorSurface surface;
  ContactSolver solver;
  AssembledState assembled;
  std::vector<LoadedPoint> teeth;
  std::vector<ToothFunctional> at_tip;
};

TEST_F(SeedGearOnReferenceCup, FrozenComplianceIsTheOneOfTheLoadPath) {
  const auto json = reference("load-path.json");
  const Eigen::MatrixXd d = frozen_compliance(ring, assembled, at_tip);
  for (Eigen::Index i = 0; i < d.rows(); ++i) {
    for (Eigen::Index j = 0; j < d.cols(); ++j) {
      const double expected = json["D_mm_per_n"][static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      // the reference was symmetrised differently: its unit responses are reciprocal to 7e-7 only
      EXPECT_NEAR(d(i, j), expected, 2e-5 * 1.16e-4);
    }
  }
}

TEST_F(SeedGearOnReferenceCup, AssembledWallStandsWhereTheLinearisedDiscsHoldIt) {
  // rear row in contact around the major axis, front row at about 60°, middle row free
  double rear = 0.0;
  double front = 0.0;
  for (std::size_t i = 0; i < assembled.stations.size(); ++i) {
    const WallStation& s = assembled.stations[i];
    const double force = assembled.force_n(static_cast<Eigen::Index>(i));
    EXPECT_GE(force, 0.0);
    if (s.row == 1) {
      EXPECT_EQ(force, 0.0);
    }
    if (s.row == 0)
      rear += force;
    if (s.row == 2)
      front += force;
    if (s.row == 0 && std::abs(s.phi_rad) < 1e-9) {
      EXPECT_NEAR(assembled.displacement(static_cast<Eigen::Index>(i), 0), 0.2, 1e-12);
    }
    if (s.row == 2 && std::abs(s.phi_rad) < 1e-9) {
      EXPECT_NEAR(assembled.displacement(static_cast<Eigen::Index>(i), 0), 0.2345, 1e-4);
    }
  }
  EXPECT_GT(rear, front);
  EXPECT_NEAR(assembled.disc_force_n, 48.2572, 1e-3); // the same sum by an independent script
}

TEST_F(SeedGearOnReferenceCup, UnilateralColumnOfTheSeedGearComesOut) {
  LoadProblem load = unilateral_problem(ring, assembled, teeth);
  // put every tooth's load at the tip, as the reference did
  const auto n = static_cast<Eigen::Index>(teeth.size());
  const auto m = assembled.force_n.size();
  const Eigen::MatrixXd wt = ring.wall_tooth(assembled.stations, assembled.normal, at_tip);
  load.problem.m.topLeftCorner(n, n) = ring.tooth_tooth(at_tip);
  load.problem.m.bottomLeftCorner(m, n) = -wt;
  load.problem.m.topRightCorner(n, m) = -wt.transpose();
  for (Eigen::Index i = 0; i < n; ++i) {
    load.problem.q(i) = teeth[static_cast<std::size_t>(i)].backlash_mm + wt.col(i).dot(assembled.force_n);
  }
  const struct {
    double theta, torque, peak;
  } expected[] = {{1e-3, 2.79, 26.7}, {2e-3, 5.81, 38.0}, {3.38e-3, 11.3, 58.4}, {4.5e-3, 16.3, 74.7}};
  for (const auto& e : expected) {
    const ContactState state = solver.solve_at(load.problem, e.theta);
    EXPECT_NEAR(2e-3 * state.torque, e.torque, 0.01 * e.torque) << e.theta; // printed to three digits
    EXPECT_NEAR(state.force.head(n).maxCoeff(), e.peak, 0.01 * e.peak) << e.theta;
  }
}

TEST_F(SeedGearOnReferenceCup, UnloadedTeethLeaveTheAssemblyAsItIs) {
  const LoadProblem load = unilateral_problem(ring, assembled, teeth);
  const ContactState state = solver.solve_at(load.problem, 0.0);
  const auto n = static_cast<Eigen::Index>(teeth.size());
  EXPECT_EQ(state.force.head(n).maxCoeff(), 0.0);
  EXPECT_NEAR((state.force.tail(assembled.force_n.size()) - assembled.force_n).cwiseAbs().maxCoeff(), 0.0,
              1e-9 * assembled.force_n.maxCoeff());
  for (Eigen::Index i = 0; i < n; ++i) {
    EXPECT_NEAR(state.gap(i), teeth[static_cast<std::size_t>(i)].backlash_mm, 1e-12);
  }
}

TEST_F(SeedGearOnReferenceCup, ExactGapCorrectionVanishesWhenTheGapIsLinear) {
  const LoadProblem load = unilateral_problem(ring, assembled, teeth);
  const ContactState start = solver.solve_torque(load.problem, 3.5e3).value();
  const auto exact = correct_to_exact_gap(ring, surface, assembled, load, start, Control::torque, solver);
  ASSERT_TRUE(exact.ok());
  EXPECT_EQ(exact->newton_steps, 0);
  EXPECT_LT(exact->residual_mm, 1e-11);
}

TEST(LagrangeWeights, ReproduceCubicsAndHitNodesExactly) {
  const std::vector<double> nodes = {21.5, 22.5, 23.5, 24.5, 25.5, 26.5, 27.5};
  for (const double x : {21.5, 21.7, 22.5, 24.4, 27.3}) {
    double sum = 0.0;
    double cubic = 0.0;
    for (const auto& [i, weight] : lagrange_weights(nodes, x)) {
      sum += weight;
      const double d = nodes[static_cast<std::size_t>(i)] - 24.0;
      cubic += weight * (d * d * d - 2 * d);
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_NEAR(cubic, std::pow(x - 24.0, 3) - 2 * (x - 24.0), 1e-12);
  }
  EXPECT_EQ(lagrange_weights(nodes, 25.5).size(), 1U);
}

TEST_F(SeedGearOnReferenceCup, TangentComplianceGivesTheGapsOfNeighbouringLoads) {
  const LoadProblem load = unilateral_problem(ring, assembled, teeth);
  const Eigen::Index n = load.point_count;
  const auto at = [&](double torque_nm) {
    return solver.solve_torque(load.problem, 1e3 * torque_nm / 2).value();
  };
  const ContactState here = at(7.0);
  const TangentCompliance tangent = tangent_compliance(load, here.force.head(n), solver);
  EXPECT_TRUE(std::equal(tangent.wall.begin(), tangent.wall.end(), here.active.begin() + n));
  int same_wall = 0;
  for (const double torque_nm : {6.9999, 7.0, 7.0001}) {
    const ContactState state = at(torque_nm);
    same_wall += std::equal(tangent.wall.begin(), tangent.wall.end(), state.active.begin() + n);
    const Eigen::VectorXd gap =
        tangent.gap_mm + tangent.d * state.force.head(n) - state.rotation * tangent.lever_mm;
    EXPECT_LT((gap - state.gap.head(n)).cwiseAbs().maxCoeff(), 1e-12) << torque_nm; // mm; gaps are of 1e-2
  }
  EXPECT_EQ(same_wall, 3); // else the law above is not bound to hold
}

TEST_F(SeedGearOnReferenceCup, TangentComplianceWithTheWallHeldIsTheFrozenOne) {
  const LoadProblem load = linear_problem(ring, assembled, teeth);
  const TangentCompliance tangent =
      tangent_compliance(load, Eigen::VectorXd::Constant(load.point_count, 3.0), solver);
  EXPECT_EQ(tangent.d, frozen_compliance(ring, assembled, load.points));
  EXPECT_TRUE(tangent.wall.empty());
}

} // namespace
} // namespace strainwave
