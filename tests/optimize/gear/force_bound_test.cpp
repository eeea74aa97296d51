#include "strainwave/optimize/gear/force_bound.hpp"
#include "strainwave/optimize/gear/linear_program.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <stdexcept>

namespace strainwave {
namespace {

TEST(LinearProgram, FindsTheVertexOfATextbookExample) {
  // G. Dantzig's kind of example: maximise 3x + 5y with x ≤ 4, 2y ≤ 12, 3x + 2y ≤ 18: (2, 6), 36.
  const auto s = solve_linear_program({-3, -5}, {{{1, 0}, 4}, {{0, 2}, 12}, {{3, 2}, 18}});
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->cost, -36.0, 1e-12);
  EXPECT_NEAR(s->x[0], 2.0, 1e-12);
  EXPECT_NEAR(s->x[1], 6.0, 1e-12);
}

TEST(LinearProgram, KeepsEquationsAndLowerLimits) {
  // x + y = 3, x ≥ 1 (−x ≤ −1), minimise y: (3, 0)
  const auto s = solve_linear_program({0, 1}, {{{1, 1}, 3, true}, {{-1, 0}, -1}});
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->x[0], 3.0, 1e-12);
}

TEST(LinearProgram, SaysWhenNothingKeepsAllRows) {
  EXPECT_FALSE(solve_linear_program({1}, {{{1}, 1}, {{-1}, -2}})); // x ≤ 1, x ≥ 2
}

TEST(LinearProgram, SaysWhenThereIsNoLowerBound) {
  EXPECT_THROW((void)solve_linear_program({-1}, {{{-1}, 0}}), std::domain_error);
}

TEST(LinearProgram, DoesNotCycle) {
  // E. Beale (1955), degenerate: the steepest-edge rule comes back to its start.
  const auto s = solve_linear_program({-0.75, 20, -0.5, 6},
                                      {{{0.25, -8, -1, 9}, 0}, {{0.5, -12, -0.5, 3}, 0}, {{0, 0, 1, 0}, 1}});
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->cost, -1.25, 1e-12);
}

class SeedGearOnePoint : public testing::Test {
protected:
  SeedGearOnePoint() {
    std::ifstream file(STRAINWAVE_TEST_REFERENCE "/load-path.json");
    const auto json = nlohmann::json::parse(file);
    compliance = json["D_mm_per_n"].get<std::vector<std::vector<double>>>();
    for (auto& row : compliance)
      for (double& d : row)
        d *= 1e3;
    clearance_um = json["backlash_mm"].get<std::vector<double>>();
    for (double& c : clearance_um)
      c *= 1e3;
    radius_mm = json["contact_radius_mm"].get<std::vector<double>>();
    for (const auto& c : json["torque_cases"]) {
      if (c["torque_nm"] == 7.0) {
        rotation_rad = c["rotation_rad"];
        peak_force_n = c["peak_force_n"];
      }
    }
  }
  std::vector<std::vector<double>> compliance;
  std::vector<double> clearance_um, radius_mm;
  double rotation_rad = 0.0, peak_force_n = 0.0;
};

TEST_F(SeedGearOnePoint, UnmodifiedFlanksCannotDoBetterAtTheirOwnRotation) {
  const auto bound = least_peak_force(compliance, clearance_um, radius_mm, 7.0, rotation_rad);
  ASSERT_TRUE(bound);
  EXPECT_NEAR(bound->peak_force_n, peak_force_n, 1e-6 * peak_force_n);
}

// By an independent program for the same data: 28.3 N and 23.7 N, printed to three digits.
TEST_F(SeedGearOnePoint, MoreRotationAllowsTheBoundsOfAnIndependentProgram) {
  const auto five = least_peak_force(compliance, clearance_um, radius_mm, 7.0, 1.05 * rotation_rad);
  const auto ten = least_peak_force(compliance, clearance_um, radius_mm, 7.0, 1.10 * rotation_rad);
  ASSERT_TRUE(five && ten);
  EXPECT_NEAR(five->peak_force_n, 28.3, 0.05);
  EXPECT_NEAR(ten->peak_force_n, 23.7, 0.05);
}

TEST_F(SeedGearOnePoint, ForcesOfTheBoundCarryTheTorqueWithinTheRotation) {
  const double theta = 1.05 * rotation_rad;
  const auto bound = least_peak_force(compliance, clearance_um, radius_mm, 7.0, theta);
  ASSERT_TRUE(bound);
  double torque_nm = 0.0;
  for (std::size_t i = bound->first; i <= bound->last; ++i) {
    const double force = bound->force_n[i - bound->first];
    EXPECT_GE(force, -1e-9);
    EXPECT_LE(force, bound->peak_force_n * (1 + 1e-9));
    torque_nm += 2e-3 * force * radius_mm[i];
    double d_um = 0.0;
    for (std::size_t j = bound->first; j <= bound->last; ++j)
      d_um += compliance[i][j] * bound->force_n[j - bound->first];
    EXPECT_LE(d_um + clearance_um[i], 1e3 * radius_mm[i] * theta + 1e-6);
  }
  EXPECT_NEAR(torque_nm, 7.0, 1e-8);
}

TEST_F(SeedGearOnePoint, TooLittleRotationCarriesNothing) {
  EXPECT_FALSE(least_peak_force(compliance, clearance_um, radius_mm, 7.0, 0.5 * rotation_rad));
}

} // namespace
} // namespace strainwave
