// The toothed seed cup of our own finite elements on the discs, against the independent compliance (physics of the seed
// gear: contact frozen as assembled with the linearised gap, point contact of three rows, other mesh, other footprint).

#include "model/contact/load_problem.hpp"
#include "model/flexspline/responses.hpp"

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

// Section "what the source text reports": every tooth loaded at its tip, backlash and lever arms of the exact discs.
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
  const auto json = testing::reference("load-path.json");
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
    // 10 %: the footprint of our hats is wider than the reference's edge line, so the tooth is stiffer at its tip
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
