#include "strainwave/optimize/gear/gear_evaluator.hpp"

#include "strainwave/common/threads/content_key.hpp"
#include "strainwave/model/results/response_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strainwave {

namespace {

Evaluation failed(std::string status, std::string message) {
  Evaluation evaluation;
  evaluation.status = std::move(status);
  evaluation.message = std::move(message);
  return evaluation;
}

/// By load, phase and tooth number modulo z, whether the tooth reaches the circular spline or not.
std::vector<double> tooth_forces(const Gear& gear, const std::vector<ForwardResult>& results) {
  const int z = gear.flexspline.teeth;
  std::vector<double> forces;
  for (const ForwardResult& result : results) {
    for (const LoadResult& load : result.load) {
      for (const PhaseForces& phase : load.phases) {
        const std::size_t first = forces.size();
        forces.resize(first + static_cast<std::size_t>(z), 0.0);
        for (std::size_t i = 0; i < phase.tooth.size(); ++i)
          forces[first + static_cast<std::size_t>((phase.tooth[i] % z + z) % z)] = phase.force_n[i];
      }
    }
  }
  return forces;
}

/// The same order, parameters inside.
std::vector<double> tooth_force_gradient(const Gear& gear, const std::vector<ForwardResult>& results,
                                         const std::vector<ForwardGradient>& gradients) {
  const int z = gear.flexspline.teeth;
  std::vector<double> slopes;
  for (std::size_t k = 0; k < results.size(); ++k) {
    const std::size_t parameters = gradients[k].parameters.size();
    for (std::size_t c = 0; c < results[k].load.size(); ++c) {
      for (std::size_t p = 0; p < results[k].load[c].phases.size(); ++p) {
        const std::vector<int>& teeth = results[k].load[c].phases[p].tooth;
        const Eigen::MatrixXd& force = gradients[k].load[c][p].force_n;
        const std::size_t first = slopes.size();
        slopes.resize(first + static_cast<std::size_t>(z) * parameters, 0.0);
        for (std::size_t i = 0; i < teeth.size(); ++i) {
          const std::size_t at = first + static_cast<std::size_t>((teeth[i] % z + z) % z) * parameters;
          for (std::size_t j = 0; j < parameters; ++j)
            slopes[at + j] = force(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        }
      }
    }
  }
  return slopes;
}

} // namespace

GearEvaluator::GearEvaluator(Gear base, DesignSpace design, std::vector<Load> loads,
                             std::shared_ptr<const ForwardModel> model,
                             std::function<void(const std::string&)> warn)
    : base_(std::move(base)), design_(std::move(design)), loads_(std::move(loads)), model_(std::move(model)),
      warn_(std::move(warn)) {
  for (const DesignVariable& variable : design_.variables()) {
    std::vector<std::string> paths = {variable.path.path()};
    for (const LinkedNumber& link : variable.links)
      paths.push_back(link.path.path());
    const bool exact = std::all_of(paths.begin(), paths.end(),
                                   [&](const std::string& path) { return has_exact_gradient(base_, path); });
    exact_.push_back(exact);
    for (const std::string& path : paths)
      if (exact && std::find(paths_.begin(), paths_.end(), path) == paths_.end())
        paths_.push_back(path);
  }
}

GearEvaluator::GearEvaluator(Gear base, DesignSpace design, std::vector<Load> loads, ForwardOptions options,
                             std::function<void(const std::string&)> warn)
    : GearEvaluator(std::move(base), std::move(design), std::move(loads),
                    std::make_shared<const ForwardModel>(options), std::move(warn)) {}

std::optional<std::size_t> GearEvaluator::pieces_of() const {
  return find_response(gear_responses(), "peak_force_n");
}

Evaluation GearEvaluator::evaluate(std::span<const double> x) {
  try {
    return point(x)->evaluation;
  } catch (const FieldError& error) { // a linked number can leave the range of its key
    return failed("out_of_range", error.what());
  }
}

std::shared_ptr<GearEvaluator::Point> GearEvaluator::point(std::span<const double> x) {
  constexpr std::size_t most_kept = 4;
  ContentKey key;
  for (const double value : x)
    key.add(value);
  {
    const std::lock_guard lock(mutex_);
    for (const auto& known : recent_)
      if (known->key == key.bits())
        return known;
  }
  std::shared_ptr<Point> solved = solve(design_.apply(base_, x));
  solved->key = key.bits();
  const std::lock_guard lock(mutex_);
  recent_.push_front(solved);
  if (recent_.size() > most_kept)
    recent_.pop_back();
  return solved;
}

std::shared_ptr<GearEvaluator::Point> GearEvaluator::solve(Gear gear) {
  auto point = std::make_shared<Point>();
  for (const Load& load : loads_) {
    gear.load = load;
    point->solutions.emplace_back();
    point->results.push_back(model_->analyze(gear, point->solutions.back()));
    const ForwardResult& result = point->results.back();
    if (warn_)
      std::for_each(result.warnings.begin(), result.warnings.end(), warn_);
    if (result.status == Status::ok)
      continue;
    point->solutions.clear();
    point->evaluation = failed(std::string(status_name(result.status)), result.message);
    return point;
  }
  Evaluation& evaluation = point->evaluation;
  evaluation.ok = true;
  evaluation.status = "ok";
  evaluation.values = read_responses(point->results);
  evaluation.pieces = tooth_forces(gear, point->results);
  for (const ForwardResult& result : point->results)
    take_worse(evaluation.certificate, *result.certificate);
  return point;
}

std::vector<double> GearEvaluator::gradient(std::span<const double> x) {
  const auto known = differentiated(x);
  return known ? known->gradient : std::vector<double>();
}

std::vector<double> GearEvaluator::piece_gradient(std::span<const double> x) {
  const auto known = differentiated(x);
  return known ? known->pieces : std::vector<double>();
}

std::shared_ptr<const GearEvaluator::Point> GearEvaluator::differentiated(std::span<const double> x) {
  std::shared_ptr<Point> at;
  try {
    at = point(x);
  } catch (const FieldError&) {
    return nullptr;
  }
  if (!at->evaluation.ok)
    return nullptr;
  {
    const std::lock_guard lock(mutex_);
    if (!at->gradient.empty())
      return at;
  }
  auto copy = std::make_shared<Point>(*at); // two threads may ask at once
  differentiate(*copy, x);
  const std::lock_guard lock(mutex_);
  at->gradient = copy->gradient;
  at->pieces = copy->pieces;
  return copy;
}

void GearEvaluator::differentiate(Point& point, std::span<const double> x) {
  const std::size_t n = x.size(), values = point.evaluation.values.size(),
                    pieces = point.evaluation.pieces.size();
  point.gradient.assign(values * n, 0.0);
  point.pieces.assign(pieces * n, 0.0);
  std::vector<double> by_path, pieces_by_path;
  if (!paths_.empty()) {
    std::vector<ForwardGradient> gradients;
    for (const auto& solution : point.solutions)
      gradients.push_back(solution->gradient(paths_));
    by_path = read_response_gradient(point.results, gradients);
    pieces_by_path = tooth_force_gradient(base_, point.results, gradients);
  }
  const auto spread = [&](const std::vector<double>& from, std::size_t rows, std::size_t i,
                          const std::string& path, double ratio, std::vector<double>& to) {
    const std::size_t m = paths_.size();
    const auto j = static_cast<std::size_t>(std::find(paths_.begin(), paths_.end(), path) - paths_.begin());
    for (std::size_t r = 0; r < rows; ++r)
      to[r * n + i] += ratio * from[r * m + j];
  };
  for (std::size_t i = 0; i < n; ++i) {
    const DesignVariable& variable = design_.variables()[i];
    if (!exact_[i]) {
      difference(point, x, i);
      continue;
    }
    const auto add = [&](const std::string& path, double ratio) {
      spread(by_path, values, i, path, ratio, point.gradient);
      spread(pieces_by_path, pieces, i, path, ratio, point.pieces);
    };
    add(variable.path.path(), 1.0);
    for (const LinkedNumber& link : variable.links)
      add(link.path.path(), link.ratio);
  }
}

void GearEvaluator::difference(Point& point, std::span<const double> x, std::size_t i) {
  const DesignVariable& variable = design_.variables()[i];
  const std::size_t n = x.size();
  const double h = 2e-3 * (variable.upper - variable.lower);
  Evaluation side[2] = {point.evaluation, point.evaluation};
  double width = 0.0;
  for (const int k : {0, 1}) {
    std::vector<double> near(x.begin(), x.end());
    near[i] = std::clamp(x[i] + (k == 0 ? -h : h), variable.lower, variable.upper);
    if (near[i] == x[i])
      continue;
    Evaluation there = evaluate(near);
    if (!there.ok || there.pieces.size() != point.evaluation.pieces.size())
      continue;
    side[k] = std::move(there);
    width += std::abs(near[i] - x[i]);
  }
  const auto slope = [&](double low, double high) {
    return width > 0.0 ? (high - low) / width : std::numeric_limits<double>::quiet_NaN();
  };
  for (std::size_t r = 0; r < point.evaluation.values.size(); ++r)
    point.gradient[r * n + i] = slope(side[0].values[r], side[1].values[r]);
  for (std::size_t r = 0; r < point.evaluation.pieces.size(); ++r)
    point.pieces[r * n + i] = slope(side[0].pieces[r], side[1].pieces[r]);
}

} // namespace strainwave
