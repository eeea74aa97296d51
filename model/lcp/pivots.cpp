#include "strainwave/model/lcp/solver.hpp"

#include <algorithm>

namespace strainwave {

/// Leaves a set on which all constrained unknowns are positive: x_ by ascending index.
void ContactSolver::drop_tension(const ContactProblem& problem) {
  for (bool dropped = true; dropped;) {
    factorize(problem);
    solve_on_set(x_);
    dropped = false;
    for (std::size_t p = 0; p < list_.size(); ++p) {
      const auto i = static_cast<std::size_t>(list_[p]);
      if (kind_[i] == constrained && !(x_[p] > 0.0))
        closed_[i] = 0, dropped = true;
    }
  }
}

void ContactSolver::remove_position(int position) {
  closed_[static_cast<std::size_t>(factor_.order()[static_cast<std::size_t>(position)])] = 0;
  const auto from = x_.begin() + position;
  std::move(from + 1, x_.begin() + factor_.size(), from);
  factor_.remove(position);
}

void ContactSolver::single_pivots(const ContactProblem& problem) {
  drop_tension(problem);
  pivot_to_optimum(problem);
}

/// Lawson–Hanson: the most negative gap enters (lowest index on a tie); whoever would be pulled leaves on the
/// way. Starts from the factor's set with its solution in x_, all constrained ones positive.
void ContactSolver::pivot_to_optimum(const ContactProblem& problem) {
  rejected_.assign(closed_.size(), 0);
  const int limit = 50 * problem.size() + 100;
  for (int pivot = 0; pivot < limit; ++pivot) {
    residual(problem);
    int entering = -1;
    double least = 0.0;
    for (int i = 0; i < problem.size(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (kind_[at] == constrained && !closed_[at] && !rejected_[at] &&
          gap_[at] < std::min(least, -rounding(at)))
        least = gap_[at], entering = i;
    }
    if (entering < 0)
      return;
    const double rotation_before = rotation_;
    closed_[static_cast<std::size_t>(entering)] = 1;
    x_[static_cast<std::size_t>(factor_.size())] = 0.0;
    factor_.append(problem, entering);
    bool progress = true;
    for (bool first = true;; first = false) {
      solve_on_set(trial_);
      ++iterations_;
      const int k = factor_.size();
      if (first && !(trial_[static_cast<std::size_t>(k - 1)] > 0.0)) { // its gap was rounding noise
        remove_position(k - 1);
        rejected_[static_cast<std::size_t>(entering)] = 1;
        rotation_ = rotation_before;
        progress = false;
        break;
      }
      const auto blocking = [&](int p) {
        const auto at = static_cast<std::size_t>(p);
        return kind_[static_cast<std::size_t>(factor_.order()[at])] == constrained && !(trial_[at] > 0.0);
      };
      const auto share = [&](int p) { // of the way at which p loses its force
        const auto at = static_cast<std::size_t>(p);
        return x_[at] > 0.0 ? x_[at] / (x_[at] - trial_[at]) : 0.0;
      };
      double alpha = 2.0;
      for (int p = 0; p < k; ++p)
        if (blocking(p))
          alpha = std::min(alpha, share(p));
      if (alpha > 1.5) {
        std::copy_n(trial_.begin(), k, x_.begin());
        break;
      }
      std::vector<int>& leaving = list_;
      leaving.clear();
      for (int p = 0; p < k; ++p)
        if (blocking(p) && share(p) <= alpha)
          leaving.push_back(p);
      for (std::size_t p = 0; p < static_cast<std::size_t>(k); ++p)
        x_[p] += alpha * (trial_[p] - x_[p]);
      for (auto p = leaving.rbegin(); p != leaving.rend(); ++p)
        remove_position(*p);
    }
    if (progress)
      std::fill(rejected_.begin(), rejected_.end(), std::uint8_t{0});
  }
}

} // namespace strainwave
