#pragma once
// The numbers that carry derivatives through templated formulas: Eigen's forward-mode scalar with a fixed
// number of partial derivatives. A formula is written once for a scalar T; T = double gives the value, T =
// Dual<N> gives the value and its N partial derivatives. Eigen's operators return expressions: always assign
// them to a T before using them twice.

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include <cmath>

namespace strainwave {

template <int N>
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, N, 1>>;

inline double value_of(double x) {
  return x;
}
template <class Derivatives>
double value_of(const Eigen::AutoDiffScalar<Derivatives>& x) {
  return x.value();
}

inline double arctan(double x) {
  return std::atan(x);
}
template <int N>
Dual<N> arctan(const Dual<N>& x) {
  return Dual<N>(std::atan(x.value()), x.derivatives() / (1.0 + x.value() * x.value()));
}

} // namespace strainwave
