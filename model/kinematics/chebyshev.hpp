#pragma once
// Chebyshev series on [-1, 1]: how smooth pieces of the neutral line are stored. A function known at the n
// points t_j = -cos(pi j/(n-1)) is replaced by the polynomial through them; for the analytic functions of
// this room the error falls geometrically with n, and the last coefficients show it. Source: L. N. Trefethen,
// Approximation Theory and Approximation Practice, SIAM 2013, chapters 3, 8 and 19.

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace strainwave {

/// Everything that depends on the number of points only.
struct ChebyshevGrid {
  explicit ChebyshevGrid(int points);
  int size;
  Eigen::VectorXd nodes;        ///< ascending, -1 and 1 included
  Eigen::MatrixXd coefficients; ///< values at the nodes -> coefficients of T_0 … T_{n-1}
  Eigen::MatrixXd integral;     ///< values at the nodes -> integral from -1 to each node
};

/// The grid with this number of points; built once, kept for the life of the program. Safe to call from any
/// thread.
const ChebyshevGrid& chebyshev_grid(int points);

/// Values at t of M series of n coefficients each, stored side by side: coefficient k of series m is c[k * M
/// + m].
template <std::size_t M>
std::array<double, M> chebyshev_sum(const double* c, int n, double t) {
  // Clenshaw's recurrence.
  std::array<double, M> b1{}, b2{}, value{};
  for (int k = n - 1; k >= 1; --k)
    for (std::size_t m = 0; m < M; ++m) {
      const double b = c[static_cast<std::size_t>(k) * M + m] + 2.0 * t * b1[m] - b2[m];
      b2[m] = b1[m];
      b1[m] = b;
    }
  for (std::size_t m = 0; m < M; ++m)
    value[m] = c[m] + t * b1[m] - b2[m];
  return value;
}

/// Largest of the last two coefficients in each column, relative to the column's largest entry: the
/// truncation error.
double chebyshev_tail(const Eigen::MatrixXd& coefficients);

} // namespace strainwave
