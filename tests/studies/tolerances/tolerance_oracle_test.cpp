// Monte Carlo and Sobol' indices of contact against a second implementation:
// tests/reference/tolerance_openturns.py (its draws, its contact solver, its statistics; the compliance alone
// is shared).

#include "strainwave/common/sampling/distribution.hpp"
#include "strainwave/common/statistics/sobol_indices.hpp"
#include "strainwave/common/statistics/summary.hpp"
#include "strainwave/model/lcp/sampled_contact.hpp"

#include "tests/model/lcp/problems.hpp"
#include "tests/support/saltelli_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strainwave {
namespace {

using namespace contact_problems;

const std::string folder = STRAINWAVE_TEST_REFERENCE;
constexpr double torque = 3500.0; // N·mm, one lobe of two

/// Peak force and rotation at the torque.
class Oracle {
public:
  Oracle()
      : oracle_(read_json(folder + "/tolerance-openturns.json")),
        path_(read_json(folder + "/load-path.json")) {}

  const nlohmann::json& recorded() const { return oracle_; }
  std::vector<double> phi() const {
    std::vector<double> all;
    for (const auto& tooth : path_["tooth"])
      all.push_back(2.0 * std::numbers::pi * tooth.get<double>() / 140.0);
    return all;
  }
  std::pair<double, double> solve(std::span<const double> error_mm) {
    std::vector<double> q(problem_.q.begin(), problem_.q.end()), r(problem_.r.begin(), problem_.r.end());
    for (std::size_t i = 0; i < q.size(); ++i)
      q[i] += error_mm[i];
    EXPECT_FALSE(solver_.solve_torque({q, r, {}}, torque, state_));
    return {*std::max_element(state_.force.begin(), state_.force.end()), state_.rotation};
  }
  std::size_t teeth() const { return static_cast<std::size_t>(problem_.size()); }

private:
  nlohmann::json oracle_, path_;
  ContactProblem problem_ = load_path(path_);
  ContactSolver general_;
  SampledContact contact_{problem_, problem_.size(), general_.solve_torque(problem_, torque).value()};
  SampleSolver solver_{contact_};
  SampledState state_;
};

TEST(ToleranceOracle, TheNominalLoadIsTheSame) {
  Oracle oracle;
  const auto [peak, rotation] = oracle.solve(std::vector<double>(oracle.teeth(), 0.0));
  EXPECT_NEAR(peak, oracle.recorded()["nominal"]["peak_force_n"].get<double>(), 1e-7);
  EXPECT_NEAR(rotation, oracle.recorded()["nominal"]["rotation_rad"].get<double>(), 1e-12);
}

TEST(ToleranceOracle, MomentsAndQuantilesUnderNoiseOfSingleTeeth) {
  Oracle oracle;
  constexpr std::uint64_t samples = 20000;
  const SampleDesign design({.design = SamplingDesign::random,
                             .seed = 3,
                             .samples = samples,
                             .dimensions = static_cast<int>(oracle.teeth())});
  const Quantile noise(Normal{0.0, 5e-4});
  std::vector<double> values[2], error(oracle.teeth());
  for (std::uint64_t k = 0; k < samples; ++k) {
    design.points(k, 1, error);
    for (double& e : error)
      e = noise(e);
    const auto [peak, rotation] = oracle.solve(error);
    values[0].push_back(peak);
    values[1].push_back(rotation);
  }
  const char* const names[] = {"peak_force_n", "rotation_rad"};
  for (int k = 0; k < 2; ++k) {
    const auto& known = oracle.recorded()["noise"]["outputs"][names[k]];
    const Summary summary = summarise(values[k], {.quantiles = {0.05, 0.5, 0.95, 0.99}, .limits = {}});
    // Two samples of the same size: their difference has √2 times the spread of one; 4 of them, where 1.96
    // are the interval.
    const auto same = [](const Estimate& own, double other) {
      const double spread = 0.5 * (own.ci95.upper - own.ci95.lower) / 1.96;
      EXPECT_NEAR(own.value, other, 4.0 * std::numbers::sqrt2 * spread);
    };
    same(summary.mean, known["mean"].get<double>());
    same(summary.std, known["std"].get<double>());
    const char* const probabilities[] = {"0.05", "0.5", "0.95", "0.99"};
    for (std::size_t p = 0; p < 4; ++p)
      same(summary.quantiles[p].estimate, known["quantiles"][probabilities[p]].get<double>());
  }
}

TEST(ToleranceOracle, SobolIndicesOfHarmonicsOfTheBacklash) {
  Oracle oracle;
  constexpr std::uint64_t blocks = 4096;
  const testing_support::SaltelliPoints points(SamplingDesign::random, 5, 3, blocks);
  const Quantile normal(Normal{0.0, 1e-3});
  const std::vector<double> phi = oracle.phi();
  std::vector<double> values[2], x(3), error(oracle.teeth());
  for (std::uint64_t k = 0; k < points.rows(); ++k) {
    points.points(k, 1, x);
    for (double& value : x)
      value = normal(value);
    for (std::size_t i = 0; i < phi.size(); ++i)
      error[i] = x[0] * std::cos(phi[i]) + x[1] * std::sin(5.0 * phi[i]) + x[2] * std::cos(12.0 * phi[i]);
    const auto [peak, rotation] = oracle.solve(error);
    values[0].push_back(peak);
    values[1].push_back(rotation);
  }
  const std::vector<std::uint8_t> ok(values[0].size(), 0);
  const char* const names[] = {"peak_force_n", "rotation_rad"};
  for (int k = 0; k < 2; ++k) {
    const auto& known = oracle.recorded()["harmonics"]["outputs"][names[k]];
    const SobolIndices indices = sobol_indices(values[k], ok, 3);
    for (std::size_t i = 0; i < 3; ++i) {
      // as above; OpenTURNS' estimator of the first index is the plain one and may have twice the spread
      const auto same = [](const Estimate& own, double other, double times) {
        EXPECT_NEAR(own.value, other, times * (own.ci95.upper - own.ci95.lower) / 2.0 / 1.96 + 0.002);
      };
      same(indices.inputs[i].first, known["first"][i].get<double>(), 4.0 * std::sqrt(5.0));
      same(indices.inputs[i].total, known["total"][i].get<double>(), 4.0 * std::sqrt(5.0));
    }
  }
}

} // namespace
} // namespace strainwave
