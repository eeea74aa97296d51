#include "strainwave/common/sampling/sources.hpp"

#include "strainwave/common/sampling/normal_quantile.hpp"

#include <stdexcept>

namespace strainwave {

SourceValues::SourceValues(std::span<const Distribution> distributions, std::vector<CorrelatedGroup> groups)
    : groups_(std::move(groups)), correlated_(distributions.size(), 0) {
  for (const Distribution& d : distributions)
    quantiles_.emplace_back(d);
  for (const CorrelatedGroup& group : groups_)
    for (std::size_t i = group.first; i < group.first + group.copula.size(); ++i) {
      if (i >= correlated_.size() || correlated_[i])
        throw std::invalid_argument("a correlated group reaches past the sources or into another group");
      correlated_[i] = 1;
    }
}

void SourceValues::transform(std::span<double> row) const {
  for (std::size_t d = 0; d < row.size(); ++d)
    row[d] = correlated_[d] ? normal_quantile(row[d]) : quantiles_[d](row[d]);
  for (const CorrelatedGroup& group : groups_) {
    const std::span<double> z = row.subspan(group.first, group.copula.size());
    group.copula.correlate(z);
    for (std::size_t i = 0; i < z.size(); ++i)
      z[i] = quantiles_[group.first + i].of_normal(z[i]);
  }
}

} // namespace strainwave
