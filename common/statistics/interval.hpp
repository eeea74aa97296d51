#pragma once
// 95 % intervals, two-sided.

#include <cstdint>
#include <span>
#include <string_view>

namespace strainwave {

struct Interval {
  double lower = 0.0;
  double upper = 0.0;
  bool contains(double x) const { return lower <= x && x <= upper; }
  double half_width() const { return 0.5 * (upper - lower); }
};

/// An end is ±infinity where the sample is too small to bound it.
struct Estimate {
  double value = 0.0;
  Interval ci95;
};

/// Phi^-1(0.975).
inline constexpr double normal_975 = 1.959963984540054;

/// 0.975 quantile of Student's t.
double student_975(double degrees_of_freedom);

/// A share from `hits` of n independent trials. Wilson (JASA 22, 1927): coverage near 95 % for every share.
Interval wilson_interval(std::uint64_t hits, std::uint64_t n);

/// Ranks (counted from 1) of the order statistics that enclose the p quantile of n independent values with at
/// least 95 %: from the binomial distribution of how many lie below. lower == 0 or upper == n + 1: the sample
/// is too small.
struct QuantileRanks {
  std::uint64_t lower, upper;
};
QuantileRanks quantile_ranks(double p, std::uint64_t n);

/// Estimate from R independent randomisations of one design: `value` is the estimate from all samples
/// together, the interval is value ± t(R − 1) s/√R with s the spread of the R estimates (Owen, "Monte Carlo
/// theory, methods and examples", ch. 17).
Estimate from_replicates(double value, std::span<const double> replicates);

} // namespace strainwave
