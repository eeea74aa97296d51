#include "strainwave/optimize/gear/linear_program.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace strainwave {

namespace {

constexpr double zero = 1e-10; ///< against coefficients of about 1

/// Rows [coefficients | bound] with a basic unknown each; the cost row is kept apart.
class Tableau {
public:
  Tableau(std::size_t unknowns, const std::vector<LinearRow>& rows) : unknowns_(unknowns) {
    const std::size_t m = rows.size();
    first_artificial_ = unknowns + m; // a slack for every row, unused where it is an equation
    width_ = first_artificial_ + m;
    for (std::size_t r = 0; r < m; ++r) {
      const double sign = rows[r].bound < 0.0 ? -1.0 : 1.0;
      std::vector<double> line(width_ + 1, 0.0);
      for (std::size_t i = 0; i < unknowns; ++i)
        line[i] = sign * rows[r].coefficient[i];
      if (!rows[r].equal)
        line[unknowns + r] = sign;
      line.back() = sign * rows[r].bound;
      const bool slack_is_basic = !rows[r].equal && sign > 0.0;
      if (!slack_is_basic)
        line[first_artificial_ + r] = 1.0;
      basis_.push_back(slack_is_basic ? unknowns + r : first_artificial_ + r);
      lines_.push_back(std::move(line));
    }
  }

  /// Drives the artificial unknowns to zero; false if they stay.
  bool find_feasible() {
    std::vector<double> cost(width_, 0.0);
    for (std::size_t i = first_artificial_; i < width_; ++i)
      cost[i] = 1.0;
    if (minimise(cost, width_) > 1e-8)
      return false;
    for (std::size_t r = 0; r < lines_.size(); ++r) { // an artificial unknown at zero leaves where it can
      if (basis_[r] < first_artificial_)
        continue;
      for (std::size_t i = 0; i < first_artificial_; ++i) {
        if (std::abs(lines_[r][i]) > 1e-7) {
          pivot(r, i);
          break;
        }
      }
    }
    return true;
  }

  double minimise_cost(const std::vector<double>& cost) {
    std::vector<double> all(width_, 0.0);
    for (std::size_t i = 0; i < unknowns_; ++i)
      all[i] = cost[i];
    return minimise(all, first_artificial_);
  }

  std::vector<double> solution() const {
    std::vector<double> x(unknowns_, 0.0);
    for (std::size_t r = 0; r < lines_.size(); ++r) {
      if (basis_[r] < unknowns_)
        x[basis_[r]] = lines_[r].back();
    }
    return x;
  }

private:
  /// Unknowns from `allowed` on stay out of the basis.
  double minimise(const std::vector<double>& cost, std::size_t allowed) {
    while (true) {
      std::size_t entering = allowed;
      for (std::size_t i = 0; i < allowed && entering == allowed; ++i) {
        if (reduced_cost(cost, i) < -zero)
          entering = i;
      }
      if (entering == allowed)
        break;
      std::size_t leaving = lines_.size();
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t r = 0; r < lines_.size(); ++r) {
        const double a = lines_[r][entering];
        if (a <= zero)
          continue;
        const double ratio = lines_[r].back() / a;
        const bool tie = leaving < lines_.size() && std::abs(ratio - least) <= zero * least;
        if (tie ? basis_[r] < basis_[leaving] : ratio < least) {
          least = ratio;
          leaving = r;
        }
      }
      if (leaving == lines_.size())
        throw std::domain_error("a linear programme without a lower bound");
      pivot(leaving, entering);
    }
    double total = 0.0;
    for (std::size_t r = 0; r < lines_.size(); ++r)
      total += cost[basis_[r]] * lines_[r].back();
    return total;
  }

  double reduced_cost(const std::vector<double>& cost, std::size_t i) const {
    double value = cost[i];
    for (std::size_t r = 0; r < lines_.size(); ++r)
      value -= cost[basis_[r]] * lines_[r][i];
    return value;
  }

  void pivot(std::size_t row, std::size_t column) {
    const double p = lines_[row][column];
    for (double& a : lines_[row])
      a /= p;
    for (std::size_t r = 0; r < lines_.size(); ++r) {
      const double factor = lines_[r][column];
      if (r == row || factor == 0.0)
        continue;
      for (std::size_t i = 0; i <= width_; ++i)
        lines_[r][i] -= factor * lines_[row][i];
    }
    basis_[row] = column;
  }

  std::size_t unknowns_, first_artificial_, width_;
  std::vector<std::vector<double>> lines_;
  std::vector<std::size_t> basis_;
};

} // namespace

std::optional<LinearSolution> solve_linear_program(const std::vector<double>& cost,
                                                   const std::vector<LinearRow>& rows) {
  Tableau tableau(cost.size(), rows);
  if (!tableau.find_feasible())
    return std::nullopt;
  LinearSolution solution;
  solution.cost = tableau.minimise_cost(cost);
  solution.x = tableau.solution();
  return solution;
}

} // namespace strainwave
