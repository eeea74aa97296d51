#include "strainwave/model/kinematics/chebyshev.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>

namespace strainwave {

ChebyshevGrid::ChebyshevGrid(int points)
    : size(points), nodes(points), coefficients(points, points), integral(points, points) {
  const int last = points - 1;
  Eigen::MatrixXd polynomial(points, points); // T_k(t_j)
  for (int j = 0; j < points; ++j) {
    // sin keeps the nodes antisymmetric to the last bit.
    nodes[j] = std::sin(0.5 * std::numbers::pi * (2 * j - last) / last);
    for (int k = 0; k < points; ++k)
      polynomial(j, k) = ((k % 2) ? -1.0 : 1.0) * std::cos(std::numbers::pi * ((j * k) % (2 * last)) / last);
  }
  for (int k = 0; k < points; ++k)
    for (int j = 0; j < points; ++j) {
      const double ends = (j == 0 || j == last ? 0.5 : 1.0) * (k == 0 || k == last ? 0.5 : 1.0);
      coefficients(k, j) = 2.0 / last * ends * polynomial(j, k);
    }
  // Integral of T_k from -1 to t, as values at the nodes.
  Eigen::MatrixXd antiderivative(points, points);
  for (int k = 0; k < points; ++k) {
    const auto primitive = [k](double angle_cos, double up, double down) {
      if (k == 0)
        return angle_cos;
      if (k == 1)
        return 0.25 * up;
      return 0.5 * (up / (k + 1) - down / (k - 1));
    };
    const auto chebyshev_at = [](int degree, double t) { return std::cos(degree * std::acos(t)); };
    const double start = primitive(-1.0, chebyshev_at(k + 1, -1.0), k > 0 ? chebyshev_at(k - 1, -1.0) : 0.0);
    for (int j = 0; j < points; ++j) {
      const double t = nodes[j];
      antiderivative(j, k) =
          primitive(t, chebyshev_at(k + 1, t), k > 0 ? chebyshev_at(k - 1, t) : 0.0) - start;
    }
  }
  integral = antiderivative * coefficients;
}

const ChebyshevGrid& chebyshev_grid(int points) {
  static std::mutex guard;
  static std::map<int, std::unique_ptr<ChebyshevGrid>> grids;
  const std::lock_guard lock(guard);
  auto& grid = grids[points];
  if (!grid)
    grid = std::make_unique<ChebyshevGrid>(points);
  return *grid;
}

double chebyshev_tail(const Eigen::MatrixXd& coefficients) {
  double tail = 0.0;
  for (Eigen::Index m = 0; m < coefficients.cols(); ++m) {
    const double largest = coefficients.col(m).cwiseAbs().maxCoeff();
    if (largest > 0.0)
      tail = std::max(tail, coefficients.col(m).tail(2).cwiseAbs().maxCoeff() / largest);
  }
  return tail;
}

} // namespace strainwave
