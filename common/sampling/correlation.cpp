#include "strainwave/common/sampling/correlation.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace strainwave {

GaussianCopula::GaussianCopula(std::size_t n, std::span<const double> p) : n_(n), factor_(n * n, 0.0) {
  if (p.size() != n * n)
    throw std::invalid_argument(
        fmt::format("a correlation of {} sources has {} numbers, got {}", n, n * n, p.size()));
  for (std::size_t i = 0; i < n; ++i) {
    if (p[i * n + i] != 1.0)
      throw std::invalid_argument(
          fmt::format("the diagonal of a correlation matrix is 1; row {} has {}", i, p[i * n + i]));
    for (std::size_t j = 0; j < i; ++j)
      if (p[i * n + j] != p[j * n + i])
        throw std::invalid_argument(fmt::format("correlation ({}, {}) differs from ({}, {})", i, j, j, i));
  }
  for (std::size_t i = 0; i < n; ++i) // Cholesky
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = p[i * n + j];
      for (std::size_t k = 0; k < j; ++k)
        sum -= factor_[i * n + k] * factor_[j * n + k];
      if (i != j) {
        factor_[i * n + j] = sum / factor_[j * n + j];
      } else if (!(sum > 1e-12)) {
        throw std::invalid_argument(
            fmt::format("no such correlation can exist: row {} contradicts the rows before it", i));
      } else {
        factor_[i * n + i] = std::sqrt(sum);
      }
    }
}

void GaussianCopula::correlate(std::span<double> z) const {
  for (std::size_t i = n_; i-- > 0;) {
    double sum = 0.0;
    for (std::size_t k = 0; k <= i; ++k)
      sum += factor_[i * n_ + k] * z[k];
    z[i] = sum;
  }
}

double normal_correlation_of_rank(double spearman) {
  return 2.0 * std::sin(std::numbers::pi * spearman / 6.0);
}

} // namespace strainwave
