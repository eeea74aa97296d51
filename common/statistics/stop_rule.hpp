#pragma once
// When is a Monte Carlo study done? When the interval of one number is as narrow as was asked for.
//
// The rule is looked at after fixed numbers of rows (the boundaries), in index order, so that threads, shards
// and restarts do not change where a study ends. Looking more than once makes the final interval a little
// optimistic; boundaries that double keep the looks few. For SamplingDesign::random only: the intervals of
// other designs need all their samples.

#include "strainwave/common/statistics/interval.hpp"

#include <optional>

namespace strainwave {

struct StopRule {
  enum class Of { mean, quantile, exceedance } of = Of::quantile;
  double argument = 0.99;          ///< probability of the quantile, or limit that is exceeded
  double half_width = 0.5;         ///< wanted, in the output's unit (exceedance: probability)
  std::uint64_t first_look = 1024; ///< rows; every later look at twice as many
};

/// Is this number of rows a boundary?
bool looks_at(const StopRule&, std::uint64_t rows);

/// The estimate the rule looks at, from the values so far (rows with a result); nothing with fewer than 4.
std::optional<Estimate> watched(const StopRule&, std::span<const double> values);

bool reached(const StopRule&, std::span<const double> values);

} // namespace strainwave
