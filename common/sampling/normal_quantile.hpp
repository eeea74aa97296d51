#pragma once
// Standard normal distribution: the quantile in the form that a million samples of some hundred dimensions
// can afford.
//
// Wichura, "Algorithm AS 241: the percentage points of the normal distribution", Applied Statistics 37
// (1988), routine PPND16: relative accuracy about 1e-16 by rational functions; 85 % of all arguments need no
// logarithm.

namespace strainwave {

/// z with Phi(z) = u, 0 < u < 1.
double normal_quantile(double u);

/// Phi(z).
double normal_cdf(double z);

} // namespace strainwave
