#include "strainwave/optimize/problem/slopes.hpp"

#include <algorithm>

namespace strainwave {

namespace {

void set_column(Slopes& slopes, std::size_t i, const SearchPoint& low, const SearchPoint& high,
                double width) {
  const std::size_t n = slopes.objective.size();
  slopes.objective[i] = (high.objective - low.objective) / width;
  for (std::size_t k = 0; k < high.constraint.size(); ++k)
    slopes.constraint[k * n + i] = (high.constraint[k] - low.constraint[k]) / width;
}

} // namespace

Slopes slopes_at(const Problem& problem, const SearchPoint& at,
                 const std::function<SearchPoint(std::span<const double>)>& ask) {
  if (!at.ok)
    return {};
  if (auto exact = problem.exact_slopes(at.y))
    return std::move(*exact);
  const std::size_t n = at.y.size();
  const std::vector<double> upper = problem.design().scaled_upper();
  Slopes slopes{true, std::vector<double>(n), std::vector<double>(problem.limits().size() * n)};
  for (std::size_t i = 0; i < n; ++i) {
    const double h = difference_step * upper[i];
    const auto neighbour = [&](double y_i) {
      std::vector<double> y = at.y;
      y[i] = y_i;
      return ask(y);
    };
    const double lower_y = std::max(0.0, at.y[i] - h), upper_y = std::min(upper[i], at.y[i] + h);
    const SearchPoint low = lower_y < at.y[i] ? neighbour(lower_y) : at;
    const SearchPoint high = upper_y > at.y[i] ? neighbour(upper_y) : at;
    if (low.ok && high.ok)
      set_column(slopes, i, low, high, upper_y - lower_y);
    else if (low.ok && lower_y < at.y[i])
      set_column(slopes, i, low, at, at.y[i] - lower_y);
    else if (high.ok && upper_y > at.y[i])
      set_column(slopes, i, at, high, upper_y - at.y[i]);
    else
      return {};
  }
  return slopes;
}

} // namespace strainwave
