#pragma once
// From a point of the unit cube to the values of all sources: distributions and correlated groups.

#include "strainwave/common/sampling/correlation.hpp"
#include "strainwave/common/sampling/distribution.hpp"

#include <optional>
#include <span>
#include <vector>

namespace strainwave {

/// Dimensions first … first + copula.size() − 1 are correlated.
struct CorrelatedGroup {
  std::size_t first = 0;
  GaussianCopula copula;
};

class SourceValues {
public:
  /// One distribution for each dimension. Throws std::invalid_argument for a group past the end or groups
  /// that overlap.
  SourceValues(std::span<const Distribution> distributions, std::vector<CorrelatedGroup> groups = {});
  std::size_t dimensions() const { return quantiles_.size(); }
  /// In place, one row: uniforms in (0, 1) become values.
  void transform(std::span<double> row) const;

private:
  std::vector<Quantile> quantiles_;
  std::vector<CorrelatedGroup> groups_;
  std::vector<char> correlated_;
};

} // namespace strainwave
