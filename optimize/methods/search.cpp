#include "strainwave/optimize/methods/search.hpp"

#include "strainwave/optimize/problem/slopes.hpp"

#include <algorithm>

namespace strainwave {

SearchPoint Recorder::evaluate(std::span<const double> y, Evaluation* whole) {
  if (monitor_.stop_requested())
    throw Ended{SearchEnd::stopped};
  if (result_.asked >= budget_)
    throw Ended{SearchEnd::budget};
  const Evaluation evaluation = problem_.evaluator().evaluate(problem_.design().unscaled(y));
  SearchPoint point = problem_.read(y, evaluation);
  if (whole)
    *whole = evaluation;
  ++result_.asked;
  monitor_.note(problem_, point);
  if (!point.ok) {
    ++result_.failed;
    result_.reason = evaluation.ok ? "the objective or a limited output is not a number" : evaluation.message;
    if (result_.failed == all_failed_limit && result_.asked == all_failed_limit)
      throw Ended{SearchEnd::all_failed};
  } else {
    result_.seen.push_back(point);
    if (!result_.best || better(point, *result_.best))
      result_.best = point;
  }
  return point;
}

const Recorder::Told& Recorder::ask(std::span<const double> y) {
  if (result_.asked > 0 && std::equal(y.begin(), y.end(), last_.y.begin(), last_.y.end()))
    return told_;
  last_ = evaluate(y);
  slopes_known_ = false;
  tell(last_);
  return told_;
}

const Recorder::Told& Recorder::ask_slopes(std::span<const double> y) {
  (void)ask(y);
  if (slopes_known_)
    return told_;
  slopes_known_ = true;
  const std::size_t n = y.size();
  told_.objective_slopes.resize(n, 0.0);
  told_.constraint_slopes.resize(n * problem_.limits().size(), 0.0);
  const Slopes slopes =
      slopes_at(problem_, last_, [this](std::span<const double> near) { return evaluate(near); });
  if (slopes.ok) {
    told_.objective_slopes = slopes.objective;
    told_.constraint_slopes = slopes.constraint;
  }
  return told_;
}

void Recorder::tell(const SearchPoint& point) {
  const std::size_t limits = problem_.limits().size();
  told_.ok = point.ok;
  if (!point.ok) {
    told_.objective = worst_objective_ + (worst_objective_ - best_objective_) + 1.0;
    worst_constraint_.resize(limits, 0.0);
    told_.constraint = worst_constraint_;
    for (double& g : told_.constraint)
      g += 1.0;
    return;
  }
  told_.objective = point.objective;
  told_.constraint = point.constraint;
  const bool first = result_.asked - result_.failed == 1;
  worst_objective_ = first ? point.objective : std::max(worst_objective_, point.objective);
  best_objective_ = first ? point.objective : std::min(best_objective_, point.objective);
  worst_constraint_.resize(limits, 0.0);
  for (std::size_t k = 0; k < limits; ++k)
    worst_constraint_[k] = std::max(worst_constraint_[k], point.constraint[k]);
}

} // namespace strainwave
