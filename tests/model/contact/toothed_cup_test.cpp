// The toothed seed cup of our own finite elements on the discs, against the independent compliance (physics of the seed
// gear: contact frozen as assembled with the linearised gap, point contact of three rows, other mesh, other footprint).

#include "model/contact/load_problem.hpp"
#include "model/flexspline/responses.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace strainwave {
namespace {

Eigen::MatrixXd compliance_at(double radius_mm) {
  static const UnitResponses responses = [] {
    const Gear gear = seed_gear();
    ResponseRequest request;
    request.flexspline = gear.flexspline;
    request.material = gear.material;
    request.mesh = gear.mesh;
    request.estimate = false;
    return unit_responses(request).value();
  }();
  const RingCompliance ring(responses, {22.5, 24.5, 26.5}, true);
  const WaveGeneratorSurface discs(
      {.eccentricity_mm = 0.6, .neutral_disc_radius_mm = 13.606, .linearised = true, .middle_z_mm = 24.5}, 13.856, 0.15);
  ContactSolver solver;
  const AssembledState assembled = assemble(ring, discs, 0.0, solver).value();
  std::vector<ToothFunctional> teeth;
  for (int tooth = -7; tooth <= 20; ++tooth) teeth.push_back(ring.tooth(tooth, radius_mm, 1.0, 0.0));
  return frozen_compliance(ring, assembled, teeth);
}

struct Height {
  double radius_mm;
  double expected_nm_per_n[4]; ///< D(0, k), k = 1 … 4, 1e-6 mm/N
};

class ToothedCupOnTheDiscs : public ::testing::TestWithParam<Height> {};

TEST_P(ToothedCupOnTheDiscs, CouplesNeighbouringTeethAsTheIndependentProgramSays) {
  const Eigen::MatrixXd d = compliance_at(GetParam().radius_mm);
  for (int k = 1; k <= 4; ++k) {
    const double expected = 1e-6 * GetParam().expected_nm_per_n[k - 1];
    EXPECT_NEAR(d(7, 7 + k), expected, 0.02 * expected) << k;
  }
}

TEST_P(ToothedCupOnTheDiscs, ComplianceIsSymmetricAndPositiveDefinite) {
  const Eigen::MatrixXd d = compliance_at(GetParam().radius_mm);
  EXPECT_LE((d - d.transpose()).cwiseAbs().maxCoeff(), 1e-12 * d.cwiseAbs().maxCoeff());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(d).eigenvalues().minCoeff(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Heights, ToothedCupOnTheDiscs,
                         ::testing::Values(Height{14.37, {89.7, 87.2, 85.9, 85.1}},
                                           Height{14.584, {93.6, 87.7, 85.2, 84.1}}));

} // namespace
} // namespace strainwave
