#pragma once
// One output over all samples: mean, standard deviation, quantiles, probability of exceeding limits,
// histogram.
//
// Two families of intervals:
//   independent samples (SamplingDesign::random)
//       mean: Student's t; standard deviation: from the fourth moment, on the logarithm, so that no normal
//       distribution is assumed; quantiles: order statistics; shares: Wilson.
//   randomised designs (Latin hypercube, Sobol')
//       every number from its spread over the independent randomisations.
// Values are in index order, so sums are the same for any number of threads.

#include "strainwave/common/statistics/interval.hpp"

#include <vector>

namespace strainwave {

struct SummaryRequest {
  std::vector<double> quantiles{0.01, 0.05, 0.5, 0.95, 0.99}; ///< in (0, 1)
  std::vector<double> limits;                                 ///< P(output > limit) is asked for
  int bins = 0;                                               ///< 0: chosen from the sample
};

struct QuantileEstimate {
  double probability = 0.0;
  Estimate estimate;
};
struct ExceedanceEstimate {
  double limit = 0.0;
  Estimate probability;
};
struct Histogram {
  double lower = 0.0, upper = 0.0;
  std::vector<std::uint64_t> counts; ///< equal bins; the upper end belongs to the last
};

struct Summary {
  std::uint64_t samples = 0;
  Estimate mean, std;
  double least = 0.0, greatest = 0.0;
  std::vector<QuantileEstimate> quantiles;
  std::vector<ExceedanceEstimate> exceedances;
  Histogram histogram;
};

/// Independent samples, at least 4. Throws std::invalid_argument for fewer.
Summary summarise(std::span<const double> values, const SummaryRequest&);

/// One span for each independent randomisation, at least 2 with at least 4 values each.
Summary summarise_randomised(std::span<const std::span<const double>> parts, const SummaryRequest&);

/// Quantile of sorted values: linear between order statistics (type 7 of Hyndman and Fan, Am. Stat. 50,
/// 1996).
double sorted_quantile(std::span<const double> sorted, double probability);

} // namespace strainwave
