#pragma once
// How an output goes along with a source: correlation with 95 % intervals, for independent samples.

#include "strainwave/common/statistics/interval.hpp"

#include <vector>

namespace strainwave {

/// Pearson's correlation; interval by Fisher's z = atanh r ± 1.96/√(n − 3) (Metron 1, 1921). At least 4
/// pairs. A constant column has no correlation: 0 with the interval [−1, 1].
Estimate pearson_correlation(std::span<const double> x, std::span<const double> y);

/// Spearman's, of the ranks, which cost more than the correlation (ties shared: ranks_of()); interval with
/// the spread √((1 + r²/2)/(n − 3)) of Bonett and Wright (Psychometrika 65, 2000).
Estimate spearman_of_ranks(std::span<const double> x_ranks, std::span<const double> y_ranks);

/// Ranks 1 … n; equal values share the mean of theirs.
std::vector<double> ranks_of(std::span<const double> values);

/// Local elasticity (x/y) dy/dx from an exact derivative: relative change of the output for a relative change
/// of the input.
double elasticity(double derivative, double input, double output);

} // namespace strainwave
