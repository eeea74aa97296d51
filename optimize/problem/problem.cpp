#include "strainwave/optimize/problem/problem.hpp"

#include "strainwave/optimize/problem/slopes.hpp"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

std::size_t response_index(std::span<const Response> responses, const std::string& name) {
  const auto index = find_response(responses, name);
  if (!index)
    throw FieldError(name, "there is no such output");
  return *index;
}

double scale_of(double bound, double baseline) {
  const double scale = std::max(std::abs(bound), std::isfinite(baseline) ? std::abs(baseline) : 0.0);
  return scale > 0.0 ? scale : 1.0;
}

double positive_baseline(const std::string& name, double baseline) {
  if (!(baseline > 0.0) || !std::isfinite(baseline))
    throw FieldError(name, "a ratio to the baseline needs a baseline value above 0, which is " +
                               shortest(baseline) + "; give min or max instead");
  return baseline;
}

} // namespace

bool better(const SearchPoint& a, const SearchPoint& b) {
  if (a.ok != b.ok)
    return a.ok;
  if (!a.ok)
    return false;
  if (feasible(a) != feasible(b))
    return feasible(a);
  return feasible(a) ? a.objective < b.objective : a.violation < b.violation;
}

Problem::Problem(DesignSpace design, Evaluator& evaluator, Objective objective,
                 std::span<const Constraint> constraints, const Evaluation& baseline)
    : design_(std::move(design)), evaluator_(&evaluator), baseline_(baseline.values) {
  const auto responses = evaluator.responses();
  *this = aiming_at(objective);
  for (const Constraint& constraint : constraints) {
    const std::size_t index = response_index(responses, constraint.output);
    const double value = baseline.values[index];
    const auto add = [&](bool upper, double bound) {
      limits_.push_back({.response = index, .upper = upper, .bound = bound, .scale = scale_of(bound, value)});
    };
    if (constraint.min)
      add(false, *constraint.min);
    if (constraint.max)
      add(true, *constraint.max);
    if (constraint.min_ratio_to_baseline)
      add(false, *constraint.min_ratio_to_baseline * positive_baseline(constraint.output, value));
    if (constraint.max_ratio_to_baseline)
      add(true, *constraint.max_ratio_to_baseline * positive_baseline(constraint.output, value));
  }
}

SearchPoint Problem::at(std::span<const double> y) const {
  return read(y, evaluator_->evaluate(design_.unscaled(y)));
}

SearchPoint Problem::read(std::span<const double> y, const Evaluation& evaluation) const {
  SearchPoint point;
  point.y.assign(y.begin(), y.end());
  if (!evaluation.ok)
    return point;
  const double value = evaluation.values[objective_];
  point.ok = std::isfinite(value);
  point.objective = (maximise_ ? -value : value) / objective_scale_;
  for (const Limit& limit : limits_) {
    const double g = limit.scaled_excess(evaluation.values[limit.response]);
    if (!std::isfinite(g))
      point.ok = false;
    point.constraint.push_back(g);
    point.violation = std::max(point.violation, g);
  }
  return point;
}

std::optional<Slopes> Problem::exact_slopes(std::span<const double> y) const {
  const std::size_t n = design_.size();
  const std::vector<double> gradient = evaluator_->gradient(design_.unscaled(y));
  if (gradient.empty())
    return std::nullopt;
  Slopes slopes{true, std::vector<double>(n), std::vector<double>(limits_.size() * n)};
  for (std::size_t i = 0; i < n; ++i) {
    const double scale = design_.variables()[i].scale;
    slopes.objective[i] = (maximise_ ? -1.0 : 1.0) * gradient[objective_ * n + i] * scale / objective_scale_;
    for (std::size_t k = 0; k < limits_.size(); ++k) {
      const Limit& limit = limits_[k];
      slopes.constraint[k * n + i] =
          (limit.upper ? 1.0 : -1.0) * gradient[limit.response * n + i] * scale / limit.scale;
    }
  }
  const auto finite = [](double slope) { return std::isfinite(slope); };
  if (!std::all_of(slopes.objective.begin(), slopes.objective.end(), finite) ||
      !std::all_of(slopes.constraint.begin(), slopes.constraint.end(), finite))
    return std::nullopt; // this evaluator does not know those of the responses that matter
  return slopes;
}

double Problem::unscaled_objective(const SearchPoint& point) const {
  return (maximise_ ? -1.0 : 1.0) * point.objective * objective_scale_;
}

Problem Problem::aiming_at(const Objective& objective) const {
  Problem other = *this;
  other.objective_ = response_index(evaluator_->responses(), objective.output);
  other.objective_scale_ = scale_of(0.0, baseline_[other.objective_]);
  other.maximise_ = objective.maximise;
  return other;
}

Problem Problem::limited(const Objective& response, double bound) const {
  Problem other = *this;
  const std::size_t index = response_index(evaluator_->responses(), response.output);
  other.limits_.push_back({.response = index,
                           .upper = !response.maximise,
                           .bound = bound,
                           .scale = scale_of(bound, baseline_[index])});
  return other;
}

Problem Problem::with(Evaluator& evaluator) const {
  Problem other = *this;
  other.evaluator_ = &evaluator;
  return other;
}

} // namespace strainwave
