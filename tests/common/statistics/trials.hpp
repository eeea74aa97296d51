#pragma once
// Repeated trials: how often does an interval cover the truth?

#include "strainwave/common/sampling/counter_random.hpp"
#include "strainwave/common/sampling/normal_quantile.hpp"
#include "strainwave/common/statistics/interval.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace strainwave {

/// Counts covered intervals of several numbers.
class Coverage {
public:
  explicit Coverage(std::size_t numbers) : hits_(numbers, 0) {}
  void add(std::size_t number, const Estimate& estimate, double truth) {
    hits_[number] += estimate.ci95.contains(truth) ? 1 : 0;
  }
  /// 95 % within ± tolerance, for every number.
  void expect(int trials, double tolerance) const {
    for (std::size_t i = 0; i < hits_.size(); ++i)
      EXPECT_NEAR(static_cast<double>(hits_[i]) / trials, 0.95, tolerance) << "number " << i;
  }

private:
  std::vector<int> hits_;
};

/// Four standard errors of a share of 0.95 in so many trials, and what an interval may honestly be off by
/// itself.
inline double coverage_tolerance(int trials) {
  return 4.0 * std::sqrt(0.95 * 0.05 / trials) + 0.01;
}

/// n independent standard normal numbers.
inline std::vector<double> normals(std::uint64_t seed, std::size_t n) {
  std::vector<double> z(n);
  random_uniforms({seed, RandomPurpose::samples}, 0, z);
  for (double& x : z)
    x = normal_quantile(x);
  return z;
}

} // namespace strainwave
