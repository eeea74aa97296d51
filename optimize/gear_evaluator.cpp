#include "optimize/gear_evaluator.hpp"

#include <algorithm>

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

} // namespace

GearEvaluator::GearEvaluator(Gear base, DesignSpace design, std::vector<Load> loads, ForwardOptions options,
                             std::function<void(const std::string&)> warn)
    : base_(std::move(base)), design_(std::move(design)), loads_(std::move(loads)), options_(options),
      warn_(std::move(warn)) {}

std::unique_ptr<ForwardModel> GearEvaluator::borrow() {
  const std::lock_guard lock(mutex_);
  if (idle_.empty())
    return std::make_unique<ForwardModel>(options_);
  auto model = std::move(idle_.back());
  idle_.pop_back();
  return model;
}

void GearEvaluator::give_back(std::unique_ptr<ForwardModel> model) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(model));
}

std::optional<std::size_t> GearEvaluator::pieces_of() const {
  return find_response(gear_responses(), "peak_force_n");
}

Evaluation GearEvaluator::evaluate(std::span<const double> x) {
  try {
    return evaluate_gear(design_.apply(base_, x));
  } catch (const FieldError& error) { // a linked number can leave the range of its key
    return failed("out_of_range", error.what());
  }
}

Evaluation GearEvaluator::evaluate_gear(Gear gear) {
  auto model = borrow();
  std::vector<ForwardResult> results;
  for (const Load& load : loads_) {
    gear.load = load;
    results.push_back(model->analyze(gear));
    const ForwardResult& result = results.back();
    if (warn_)
      std::for_each(result.warnings.begin(), result.warnings.end(), warn_);
    if (result.status == Status::ok)
      continue;
    give_back(std::move(model));
    return failed(std::string(status_name(result.status)), result.message);
  }
  give_back(std::move(model));
  Evaluation evaluation;
  evaluation.ok = true;
  evaluation.status = "ok";
  evaluation.values = read_responses(results);
  evaluation.pieces = tooth_forces(gear, results);
  for (const ForwardResult& result : results)
    take_worse(evaluation.certificate, *result.certificate);
  return evaluation;
}

} // namespace strainwave
