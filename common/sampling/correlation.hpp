#pragma once
// Correlation between sources: the Gaussian copula.
//
// Independent standard normal numbers z become L z with L Lᵀ = P, the correlation matrix of the underlying
// normals; each source then takes the quantile of Phi(L z). For normal sources P is their correlation itself.
// For others the rank correlation is kept whatever the distribution: Spearman's rho_s = (6/π) asin(P/2)
// (Kruskal, JASA 53, 1958).

#include <cstddef>
#include <span>
#include <vector>

namespace strainwave {

class GaussianCopula {
public:
  /// n × n, row by row; symmetric with ones on the diagonal. Throws std::invalid_argument when it is no
  /// correlation matrix (the message names the row in which it stops being positive definite).
  GaussianCopula(std::size_t n, std::span<const double> correlation);
  std::size_t size() const { return n_; }
  void correlate(std::span<double> normals) const; ///< in place

private:
  std::size_t n_;
  std::vector<double> factor_;
};

/// P that gives the wanted rank correlation.
double normal_correlation_of_rank(double spearman);

} // namespace strainwave
