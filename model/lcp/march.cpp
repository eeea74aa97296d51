#include "strainwave/model/lcp/march.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace strainwave {

namespace {

/// The problem with its closed set frozen.
class FrozenSet {
public:
  explicit FrozenSet(const ContactProblem& problem)
      : problem_(problem), x_(static_cast<std::size_t>(problem.size())) {
    load_.resize(x_.size());
    gap_.resize(x_.size());
    for (int i = 0; i < problem.size(); ++i)
      largest_diagonal_ = std::max(largest_diagonal_, problem.m(i, i));
    factor_.reset(problem.size());
  }

  void freeze(const ActiveSet& active) {
    active_ = active;
    std::vector<int> list;
    for (std::size_t i = 0; i < active.size(); ++i)
      if (active[i])
        list.push_back(static_cast<int>(i));
    factor_.factorize(problem_, list);
  }

  /// Solves at the rotation; false when some index wants to change sides there.
  bool consistent_at(double rotation) {
    factor_.solve(-1.0, rotation, x_.data());
    double force_sum = 0.0;
    for (int p = 0; p < factor_.size(); ++p) {
      if (x_[static_cast<std::size_t>(p)] < 0.0)
        return false;
      force_sum += x_[static_cast<std::size_t>(p)];
    }
    for (int i = 0; i < problem_.size(); ++i)
      load_[static_cast<std::size_t>(i)] = problem_.q[i] - rotation * problem_.r[i];
    add_columns(problem_.m, factor_.order(), x_.data(), load_.data(), gap_.data());
    for (int i = 0; i < problem_.size(); ++i) {
      const double scale =
          std::abs(problem_.q[i]) + std::abs(rotation * problem_.r[i]) + largest_diagonal_ * force_sum;
      const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * scale;
      if (!active_[static_cast<std::size_t>(i)] && gap_[static_cast<std::size_t>(i)] < -rounding)
        return false;
    }
    return true;
  }

  double torque() const {
    double sum = 0.0;
    for (std::size_t p = 0; p < factor_.order().size(); ++p)
      sum += problem_.r[factor_.order()[p]] * x_[p];
    return sum;
  }

private:
  const ContactProblem& problem_;
  ActiveFactor factor_;
  ActiveSet active_;
  std::vector<double> x_, load_, gap_;
  double largest_diagonal_ = 0.0;
};

} // namespace

March march(const ContactProblem& problem, double start_rotation, double end_rotation,
            const MarchOptions& options, ContactSolver& solver) {
  if (!(options.least_step > 0.0 && options.least_step <= options.step) || !std::isfinite(start_rotation) ||
      !std::isfinite(end_rotation) || !(start_rotation <= end_rotation))
    throw std::invalid_argument("marching needs 0 < least step <= step and a finite range of rotations");
  March result;
  result.last = solver.solve_at(problem, start_rotation);
  FrozenSet frozen(problem);
  frozen.freeze(result.last.active);
  result.rotation.push_back(start_rotation);
  result.torque.push_back(result.last.torque);
  double rotation = start_rotation, step = options.step;
  ContactState changed;
  while (rotation < end_rotation) {
    const double next = std::min(end_rotation, rotation + step);
    if (!(next > rotation))
      throw std::invalid_argument("marching: the least step vanishes beside the rotation");
    ++result.tried;
    if (frozen.consistent_at(next)) {
      rotation = next;
      result.rotation.push_back(rotation);
      result.torque.push_back(frozen.torque());
      continue;
    }
    if (step > options.least_step) {
      step = std::max(0.5 * step, options.least_step);
      ++result.halved;
      continue;
    }
    solver.solve_at(problem, next, result.last.active, {}, changed);
    for (std::size_t i = 0; i < changed.active.size(); ++i)
      if (changed.active[i] != result.last.active[i])
        result.changes.push_back({next, static_cast<int>(i), changed.active[i] != 0});
    std::swap(result.last, changed);
    frozen.freeze(result.last.active);
    rotation = next;
    step = options.step;
    result.rotation.push_back(rotation);
    result.torque.push_back(result.last.torque);
  }
  solver.solve_at(problem, end_rotation, ActiveSet(result.last.active), {}, result.last);
  return result;
}

double March::torque_at(double at) const {
  if (rotation.empty() || !(at >= rotation.front() && at <= rotation.back()))
    throw std::out_of_range("this rotation was not marched over");
  const auto above = std::lower_bound(rotation.begin(), rotation.end(), at);
  const auto i = static_cast<std::size_t>(above - rotation.begin());
  if (i == 0)
    return torque.front();
  const double share = (at - rotation[i - 1]) / (rotation[i] - rotation[i - 1]);
  return torque[i - 1] + share * (torque[i] - torque[i - 1]);
}

} // namespace strainwave
