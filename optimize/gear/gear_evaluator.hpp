#pragma once
// The evaluator of real gears: a design put into a base gear, analysed by the forward model under a list of
// loads.
//
// All threads, and whoever else works on the same gears (bounds, variants, other evaluators), share one
// forward model: a cup is solved once. What it remembers changes the time, never the numbers.
//
// Gradients are exact (model/forward/gradient.hpp) for variables whose keys, linked ones included, act
// through flanks, poses and assembly. A variable that changes the finite elements or the discs' width is
// differenced as a whole: central, step 0.002 of its range, one-sided at a bound. The finite elements of a
// thin cup carry rounding of some 1e-8 of a response, so that a smaller step would be worse: what is left is
// some 1e-5 of the response over the range, and 1e-6 of its third derivative. The contact states of the last
// few points are kept: a gradient at a point that has just been evaluated costs its derivatives alone.

#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/forward/gradient.hpp"
#include "strainwave/optimize/problem/design.hpp"
#include "strainwave/optimize/problem/evaluator.hpp"

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>

namespace strainwave {

class GearEvaluator : public Evaluator {
public:
  /// Each of `loads` replaces the load of `base`; rated torque included. `warn` hears sentences for people (a
  /// damaged cache file), from any thread.
  GearEvaluator(Gear base, DesignSpace design, std::vector<Load> loads,
                std::shared_ptr<const ForwardModel> model, std::function<void(const std::string&)> warn = {});
  /// With a model of its own.
  GearEvaluator(Gear base, DesignSpace design, std::vector<Load> loads, ForwardOptions options = {},
                std::function<void(const std::string&)> warn = {});

  std::span<const Response> responses() const override { return gear_responses(); }
  Evaluation evaluate(std::span<const double> x) override;
  /// peak_force_n: the forces of all teeth, tooth by tooth in every phase of every load.
  std::optional<std::size_t> pieces_of() const override;
  std::vector<double> gradient(std::span<const double> x) override;
  std::vector<double> piece_gradient(std::span<const double> x) override;
  /// Whether variable i has an exact derivative.
  bool exact(std::size_t i) const { return exact_[i]; }
  /// The unmodified gear.
  Evaluation evaluate_base() { return evaluate_gear(base_); }

  const DesignSpace& design() const { return design_; }
  /// The gear itself, for files and reports.
  Gear gear(std::span<const double> x) const { return design_.apply(base_, x); }

private:
  /// What is kept of a point.
  struct Point {
    std::string key;
    std::vector<ForwardResult> results;
    std::vector<std::shared_ptr<const ForwardSolution>> solutions; ///< none where a load has no solution
    std::vector<double> gradient, pieces;                          ///< once asked for
    Evaluation evaluation;
  };

  Evaluation evaluate_gear(Gear gear) { return solve(std::move(gear))->evaluation; }
  std::shared_ptr<Point> solve(Gear gear);
  std::shared_ptr<Point> point(std::span<const double> x);
  /// The point with its gradients; null where it has none.
  std::shared_ptr<const Point> differentiated(std::span<const double> x);
  void differentiate(Point& point, std::span<const double> x);
  /// Variable i by differences of whole evaluations.
  void difference(Point& point, std::span<const double> x, std::size_t i);

  Gear base_;
  DesignSpace design_;
  std::vector<Load> loads_;
  std::shared_ptr<const ForwardModel> model_;
  std::function<void(const std::string&)> warn_;
  std::mutex mutex_;
  std::vector<bool> exact_;
  std::vector<std::string> paths_;           ///< of the exact variables and what is linked to them, each once
  std::list<std::shared_ptr<Point>> recent_; ///< the latest first
};

} // namespace strainwave
