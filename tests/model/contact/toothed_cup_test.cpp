// The toothed seed cup of our own finite elements on the discs, against the independent compliance (physics
// of the seed gear: contact frozen as assembled with the linearised gap, point contact of three rows, other
// mesh, other footprint).

#include "strainwave/model/contact/load_problem.hpp"
#include "strainwave/model/flexspline/responses.hpp"

#include "tests/model/contact/reference_cup.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace strainwave {
namespace {

const UnitResponses& seed_responses() {
  static const UnitResponses responses = [] {
    const Gear gear = seed_gear();
    ResponseRequest request;
    request.flexspline = gear.flexspline;
    request.material = gear.material;
    request.mesh = gear.mesh;
    request.mesh.tooth_height = 4;
    request.flank_heights = 9; // hats 0.11 mm wide: near to the edge lines of the reference
    request.estimate = false;
    return unit_responses(request).value();
  }();
  return responses;
}

WaveGeneratorSurface seed_discs(bool linearised) {
  return {WaveGeneratorSurface::Discs{.eccentricity_mm = 0.6,
                                      .neutral_disc_radius_mm = 13.606,
                                      .linearised = linearised,
                                      .middle_z_mm = 24.5},
          13.856, 0.15};
}

/// The cup on its discs, and teeth −7 … 20 loaded at one radius of the undeformed flank.
struct TeethOnTheDiscs {
  explicit TeethOnTheDiscs(double radius_mm) {
    for (int tooth = -7; tooth <= 20; ++tooth)
      teeth.push_back(ring.tooth(tooth, radius_mm, 1.0, 0.0));
  }
  Eigen::MatrixXd compliance() const { return frozen_compliance(ring, assembled, teeth); }
  /// Column by column from unit forces and the held wall's reaction: nothing makes this one symmetric.
  Eigen::MatrixXd by_columns() const {
    const auto n = static_cast<Eigen::Index>(teeth.size());
    Eigen::MatrixXd d(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, j);
      d.col(j) =
          ring.tooth_displacement(teeth, teeth, unit) -
          ring.tooth_displacement(teeth, assembled.stations, frozen_reaction(ring, assembled, teeth, unit));
    }
    return d;
  }

  RingCompliance ring{seed_responses(), {22.5, 24.5, 26.5}, true};
  ContactSolver solver;
  AssembledState assembled = assemble(ring, seed_discs(true), 0.0, solver).value();
  std::vector<ToothFunctional> teeth;
};

struct Height {
  double radius_mm;
  double expected_nm_per_n[4]; ///< D(0, k), k = 1 … 4, 1e-6 mm/N
};

class ToothedCupOnTheDiscs : public ::testing::TestWithParam<Height> {};

TEST_P(ToothedCupOnTheDiscs, CouplesNeighbouringTeethAsTheIndependentProgramSays) {
  const Eigen::MatrixXd d = TeethOnTheDiscs(GetParam().radius_mm).compliance();
  for (int k = 1; k <= 4; ++k) {
    const double expected = 1e-6 * GetParam().expected_nm_per_n[k - 1];
    EXPECT_NEAR(d(7, 7 + k), expected, 0.02 * expected) << k;
  }
}

TEST_P(ToothedCupOnTheDiscs, ComplianceIsSymmetricAndPositiveDefinite) {
  const TeethOnTheDiscs cup(GetParam().radius_mm);
  const Eigen::MatrixXd d = cup.compliance();
  const Eigen::MatrixXd columns = cup.by_columns();
  EXPECT_LE((columns - columns.transpose()).cwiseAbs().maxCoeff(), 1e-12 * d.cwiseAbs().maxCoeff());
  EXPECT_LE((columns - d).cwiseAbs().maxCoeff(), 1e-12 * d.cwiseAbs().maxCoeff());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(d).eigenvalues().minCoeff(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Heights, ToothedCupOnTheDiscs,
                         ::testing::Values(Height{14.37, {89.7, 87.2, 85.9, 85.1}},
                                           Height{14.584, {93.6, 87.7, 85.2, 84.1}}));

// Gap, direction and equilibrium of a wall that carries, recomputed from the forces alone.
void expect_exact(const RingCompliance& ring, const WaveGeneratorSurface& discs,
                  const std::vector<WallStation>& stations, const Eigen::MatrixX2d& wall_force,
                  const std::vector<ToothFunctional>& teeth, const Eigen::VectorXd& tooth_force) {
  const Eigen::MatrixX2d u = ring.wall_displacement(stations, stations, wall_force, teeth, -tooth_force);
  const double rounding_mm =
      gap_rounding_mm(u.rows() + tooth_force.size(), discs.inner_radius_mm(), u.cwiseAbs().maxCoeff());
  int closed = 0;
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    const WallStation& s = stations[static_cast<std::size_t>(i)];
    const WallGap gap = discs.gap(s.phi_rad, s.z_mm, u(i, 0), u(i, 1));
    const double along = wall_force(i, 0) * gap.radial + wall_force(i, 1) * gap.circumferential,
                 across = wall_force(i, 1) * gap.radial - wall_force(i, 0) * gap.circumferential;
    EXPECT_GE(along, 0.0);
    EXPECT_NEAR(across, 0.0, 1e-12 * along);
    EXPECT_GE(gap.gap_mm, -rounding_mm);
    if (along > 0.0) {
      ++closed;
      EXPECT_LE(gap.gap_mm, rounding_mm);
    }
  }
  EXPECT_GT(closed, 20);
}

TEST(ExactWallContact, ForcesActAlongTheNormalsOfTheDiscsWhereTheWallStands) {
  const RingCompliance ring(seed_responses(), {22.5, 24.5, 26.5}, true);
  const WaveGeneratorSurface discs = seed_discs(false);
  ContactSolver solver;
  const AssembledState assembled = assemble(ring, discs, 0.0, solver).value();
  expect_exact(ring, discs, assembled.stations, assembled.force_components(), {}, Eigen::VectorXd());
  std::vector<LoadedPoint> points;
  for (int tooth = -3; tooth <= 6; ++tooth)
    points.push_back(
        {.tooth = tooth, .backlash_mm = 4e-3, .contact_radius_mm = 14.6, .flank_radius_mm = 14.5});
  const LoadProblem load = unilateral_problem(ring, assembled, points);
  for (const double torque_nmm : {500.0, 3500.0}) {
    const ContactState start = solver.solve_torque(load.problem, torque_nmm).value();
    const ExactLoad exact =
        correct_to_exact_gap(ring, discs, assembled, load, start, Control::torque, solver).value();
    const Eigen::VectorXd force = exact.state.force.head(load.point_count);
    EXPECT_NEAR(load.problem.r.head(load.point_count).dot(force), torque_nmm, 1e-12 * torque_nmm);
    expect_exact(ring, discs, assembled.stations, exact.wall_force, load.points, force);
    // teeth: c + d − d(assembly) − R θ
    const double rounding_mm = gap_rounding_mm(exact.state.force.size(), discs.inner_radius_mm(), 1.0);
    const Eigen::VectorXd gap = ring.tooth_displacement(load.points, load.points, force) -
                                ring.tooth_displacement(load.points, assembled.stations,
                                                        exact.wall_force - assembled.force_components());
    for (Eigen::Index k = 0; k < force.size(); ++k) {
      const double left = gap(k) + 4e-3 - 14.6 * exact.state.rotation;
      EXPECT_GE(left, -rounding_mm);
      if (force(k) > 0.0) {
        EXPECT_LE(left, rounding_mm);
      }
    }
  }
}

// Section "what the source text reports": every tooth loaded at its tip, backlash and lever arms of the exact
// discs.
struct Column {
  bool unilateral, linearised_gap;
  double torque_nm[4]; ///< at 1e-3, 2e-3, 3.38e-3, 4.5e-3 rad
  double peak_n;       ///< at 3.38e-3 rad
  double zone_lo_deg, zone_hi_deg;
};

class SeedGearLoadedAtTheTips : public ::testing::TestWithParam<Column> {};

TEST_P(SeedGearLoadedAtTheTips, ReproducesTheIndependentColumn) {
  const Column& column = GetParam();
  const RingCompliance ring(seed_responses(), {22.5, 24.5, 26.5}, true);
  const WaveGeneratorSurface discs = seed_discs(column.linearised_gap);
  ContactSolver solver;
  const AssembledState assembled = assemble(ring, discs, 0.0, solver).value();
  const auto json = testing_support::reference("load-path.json");
  std::vector<LoadedPoint> points;
  for (std::size_t i = 0; i < json["tooth"].size(); ++i) {
    points.push_back({.tooth = json["tooth"][i],
                      .backlash_mm = json["backlash_mm"][i],
                      .contact_radius_mm = json["contact_radius_mm"][i],
                      .flank_radius_mm = 14.584});
  }
  const LoadProblem load = column.unilateral ? unilateral_problem(ring, assembled, points)
                                             : linear_problem(ring, assembled, points);
  const double rotation[4] = {1e-3, 2e-3, 3.38e-3, 4.5e-3};
  for (int i = 0; i < 4; ++i) {
    ContactState state = solver.solve_at(load.problem, rotation[i]);
    if (column.unilateral && !column.linearised_gap) {
      state =
          correct_to_exact_gap(ring, discs, assembled, load, state, Control::rotation, solver).value().state;
    }
    EXPECT_NEAR(2e-3 * state.torque, column.torque_nm[i], 0.04 * column.torque_nm[i]) << rotation[i];
    if (i != 2)
      continue;
    // 10 %: the footprint of our hats is wider than the reference's edge line, so the tooth is stiffer at its
    // tip
    EXPECT_NEAR(state.force.head(load.point_count).maxCoeff(), column.peak_n, 0.10 * column.peak_n);
    double lo = 90.0;
    double hi = -90.0;
    const double tooth = 360.0 / 140.0;
    for (int k = 0; k < load.point_count; ++k) {
      if (!(state.force(k) > 0.0))
        continue;
      lo = std::min(lo, tooth * points[static_cast<std::size_t>(k)].tooth);
      hi = std::max(hi, tooth * points[static_cast<std::size_t>(k)].tooth);
    }
    EXPECT_NEAR(lo, column.zone_lo_deg, 1.01 * tooth);
    EXPECT_NEAR(hi, column.zone_hi_deg, 1.01 * tooth);
  }
}

INSTANTIATE_TEST_SUITE_P(Columns, SeedGearLoadedAtTheTips,
                         ::testing::Values(Column{false, true, {3.3, 7.9, 14.5, 19.9}, 84.0, -5.14, 15.43},
                                           Column{true, true, {2.79, 5.81, 11.3, 16.3}, 58.4, -10.29, 15.43},
                                           Column{
                                               true, false, {3.02, 6.26, 11.85, 16.9}, 61.5, -7.71, 15.43}));

} // namespace
} // namespace strainwave
