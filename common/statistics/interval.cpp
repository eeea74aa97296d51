#include "strainwave/common/statistics/interval.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <stdexcept>

namespace strainwave {

double student_975(double degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975);
}

Interval wilson_interval(std::uint64_t hits, std::uint64_t n) {
  const double total = static_cast<double>(n), p = static_cast<double>(hits) / total;
  const double z2 = normal_975 * normal_975 / total;
  const double middle = (p + 0.5 * z2) / (1.0 + z2);
  const double half = normal_975 / (1.0 + z2) * std::sqrt(p * (1.0 - p) / total + 0.25 * z2 / total);
  return {hits == 0 ? 0.0 : middle - half, hits == n ? 1.0 : middle + half};
}

QuantileRanks quantile_ranks(double p, std::uint64_t n) {
  using namespace boost::math;
  // Number of values below the quantile: B. The interval [x(l), x(u)) covers when l <= B <= u − 1.
  using Down = policies::policy<policies::discrete_quantile<policies::integer_round_down>>;
  using Up = policies::policy<policies::discrete_quantile<policies::integer_round_up>>;
  const double total = static_cast<double>(n);
  const double lower = quantile(binomial_distribution<double, Down>(total, p), 0.025);
  const double upper = quantile(binomial_distribution<double, Up>(total, p), 0.975);
  return {static_cast<std::uint64_t>(std::max(lower, 0.0)), static_cast<std::uint64_t>(upper) + 1};
}

Estimate from_replicates(double value, std::span<const double> replicates) {
  if (replicates.size() < 2)
    throw std::logic_error("from_replicates: one replicate has no spread");
  const double r = static_cast<double>(replicates.size());
  double mean = 0.0, square = 0.0;
  for (double x : replicates)
    mean += x / r;
  for (double x : replicates)
    square += (x - mean) * (x - mean);
  const double half = student_975(r - 1.0) * std::sqrt(square / (r - 1.0) / r);
  return {value, {value - half, value + half}};
}

} // namespace strainwave
