#pragma once
// The evaluator of real gears: a design put into a base gear, analysed by the forward model under a list of
// loads.
//
// A forward model lets only one thread at a time into a stage, so every thread that evaluates borrows a model
// of its own. What a model remembers is unit responses and assemblies by content; it changes the time, never
// the numbers.

#include "model/forward/forward.hpp"
#include "optimize/design.hpp"
#include "optimize/evaluator.hpp"

#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace strainwave {

class GearEvaluator : public Evaluator {
public:
  /// Each of `loads` replaces the load of `base`; rated torque included. `warn` hears sentences for people (a
  /// damaged cache file), from any thread.
  GearEvaluator(Gear base, DesignSpace design, std::vector<Load> loads, ForwardOptions options = {},
                std::function<void(const std::string&)> warn = {});

  std::span<const Response> responses() const override { return gear_responses(); }
  Evaluation evaluate(std::span<const double> x) override;
  /// peak_force_n: the forces of all teeth, tooth by tooth in every phase of every load.
  std::optional<std::size_t> pieces_of() const override;
  /// The unmodified gear.
  Evaluation evaluate_base() { return evaluate_gear(base_); }

  const DesignSpace& design() const { return design_; }
  /// The gear itself, for files and reports.
  Gear gear(std::span<const double> x) const { return design_.apply(base_, x); }

private:
  Evaluation evaluate_gear(Gear gear);
  std::unique_ptr<ForwardModel> borrow();
  void give_back(std::unique_ptr<ForwardModel> model);

  Gear base_;
  DesignSpace design_;
  std::vector<Load> loads_;
  ForwardOptions options_;
  std::function<void(const std::string&)> warn_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<ForwardModel>> idle_;
};

} // namespace strainwave
