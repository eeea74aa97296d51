#pragma once
// Distributions of sources, drawn by their quantile: value = quantile(u) with u uniform in (0, 1). So the
// same point of a design moves the same way through every distribution, and nothing depends on a library's
// own generators.

#include <span>
#include <string>
#include <variant>
#include <vector>

namespace strainwave {

struct Normal {
  double mean = 0.0;
  double std = 1.0; ///< > 0
};
/// A normal distribution cut at both limits and scaled up again; mean and std are those before the cut.
struct TruncatedNormal {
  double mean = 0.0;
  double std = 1.0;
  double lower = -3.0;
  double upper = 3.0;
};
struct Uniform {
  double lower = 0.0;
  double upper = 1.0;
};
struct Triangular {
  double lower = 0.0;
  double mode = 0.5;
  double upper = 1.0;
};
/// mean and std of the value itself (not of its logarithm), both > 0.
struct Lognormal {
  double mean = 1.0;
  double std = 0.1;
};
/// A measured distribution: cumulative[i] is the share of values at or below value[i], ascending from 0 to 1;
/// in between it is linear.
struct Tabulated {
  std::vector<double> value;
  std::vector<double> cumulative;
};

using Distribution = std::variant<Normal, TruncatedNormal, Uniform, Triangular, Lognormal, Tabulated>;

/// Throws std::invalid_argument with one sentence if the numbers make no distribution.
void check_distribution(const Distribution&);

/// Ready to be drawn from: what does not depend on u is computed once.
class Quantile {
public:
  explicit Quantile(const Distribution&); ///< throws as check_distribution
  double operator()(double u) const;
  /// quantile(Phi(z)): what correlated sources ask for. Exact for normal and lognormal distributions.
  double of_normal(double z) const;
  bool wants_normal() const { return normal_based_; } ///< is of_normal the cheaper one?

private:
  Distribution distribution_;
  bool normal_based_ = false;
  double a_ = 0.0, b_ = 0.0;
};

double mean_of(const Distribution&);
double std_of(const Distribution&);

} // namespace strainwave
