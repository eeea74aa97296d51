#pragma once
// Small words of the gradient's sources. Internal to gradient_*.cpp.

#include <Eigen/Dense>

#include <vector>

namespace strainwave::slopes {

/// Lines of a point's change.
enum Line { of_gap, of_radius, of_height, of_angle };

/// τ of the normals: turned towards larger φ by 90 degrees.
inline Eigen::MatrixX2d tangents(const Eigen::MatrixX2d& normal) {
  Eigen::MatrixX2d result(normal.rows(), 2);
  result.col(0) = -normal.col(1);
  result.col(1) = normal.col(0);
  return result;
}

template <class T>
std::vector<T> twice(const std::vector<T>& list) {
  std::vector<T> both = list;
  both.insert(both.end(), list.begin(), list.end());
  return both;
}

inline Eigen::MatrixX2d stacked(const Eigen::MatrixX2d& above, const Eigen::MatrixX2d& below) {
  Eigen::MatrixX2d both(above.rows() + below.rows(), 2);
  both << above, below;
  return both;
}

} // namespace strainwave::slopes
