#include "strainwave/optimize/methods/epigraph.hpp"

#include "strainwave/optimize/problem/slopes.hpp"

#include <algorithm>
#include <cmath>

namespace strainwave {

bool Epigraph::has_pieces() const {
  return !problem_.maximise() && problem_.evaluator().pieces_of() == problem_.objective_response();
}

std::optional<std::vector<double>> Epigraph::values(const Evaluation& evaluation) const {
  const SearchPoint point = problem_.read({}, evaluation);
  if (!point.ok)
    return std::nullopt;
  std::vector<double> rows;
  if (has_pieces()) {
    for (const double piece : evaluation.pieces)
      rows.push_back(piece / problem_.objective_scale());
  } else {
    rows.push_back(point.objective);
  }
  rows.insert(rows.end(), point.constraint.begin(), point.constraint.end());
  return rows;
}

std::optional<std::vector<double>> Epigraph::exact_slopes(std::span<const double> y, std::size_t rows) const {
  const auto whole = problem_.exact_slopes(y);
  if (!whole)
    return std::nullopt;
  std::vector<double> slope;
  if (has_pieces()) {
    const std::size_t n = y.size();
    slope = problem_.evaluator().piece_gradient(problem_.design().unscaled(y));
    if (slope.size() + whole->constraint.size() != rows * n)
      return std::nullopt;
    for (std::size_t k = 0; k < slope.size(); ++k)
      slope[k] *= problem_.design().variables()[k % n].scale / problem_.objective_scale();
  } else {
    slope = whole->objective;
  }
  slope.insert(slope.end(), whole->constraint.begin(), whole->constraint.end());
  return slope;
}

std::optional<std::vector<double>>
Epigraph::slopes(std::span<const double> y, const std::vector<double>& values,
                 const std::function<Evaluation(std::span<const double>)>& ask) const {
  const std::size_t n = y.size(), rows = values.size();
  if (auto exact = exact_slopes(y, rows))
    return exact;
  const std::vector<double> upper = problem_.design().scaled_upper();
  std::vector<double> slope(rows * n);
  for (std::size_t i = 0; i < n; ++i) {
    const double h = difference_step * upper[i];
    std::vector<double> low = values, high = values;
    double width = 0.0;
    for (const double side : {-1.0, 1.0}) {
      std::vector<double> near(y.begin(), y.end());
      near[i] = std::clamp(y[i] + side * h, 0.0, upper[i]);
      if (near[i] == y[i])
        continue;
      const auto there = this->values(ask(near));
      if (!there || there->size() != rows)
        continue;
      (side < 0.0 ? low : high) = *there;
      width += std::abs(near[i] - y[i]);
    }
    if (width == 0.0)
      return std::nullopt;
    for (std::size_t r = 0; r < rows; ++r)
      slope[r * n + i] = (high[r] - low[r]) / width;
  }
  return slope;
}

} // namespace strainwave
