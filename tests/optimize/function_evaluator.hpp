#pragma once
// Test problems with known answers: plain functions of a few numbers as evaluators, and designs of as many
// numbers of a gear to carry them (the eight removals of a flank, whose range is wide).

#include "strainwave/optimize/problem/problem.hpp"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace strainwave {

/// (Not "g" + …: g++ 12 warns wrongly about overlapping copies, GCC bug 105651.)
inline std::string limit_name(std::size_t k) {
  return std::string("g").append(std::to_string(k));
}

inline double square(double a) {
  return a * a;
}

/// Responses "f", "g0", "g1", … of a function that returns them all.
class FunctionEvaluator : public Evaluator {
public:
  using Function = std::function<std::vector<double>(std::span<const double>)>;

  /// With `pieces`, the function returns f's pieces behind f and the limits.
  FunctionEvaluator(Function function, std::size_t limits, std::size_t pieces = 0)
      : function_(std::move(function)), pieces_(pieces) {
    names_.push_back("f");
    for (std::size_t k = 0; k < limits; ++k)
      names_.push_back(limit_name(k));
    for (const std::string& name : names_)
      responses_.push_back({name, "", ""});
  }

  std::span<const Response> responses() const override { return responses_; }
  Evaluation evaluate(std::span<const double> x) override {
    ++calls;
    Evaluation evaluation;
    evaluation.values = function_(x);
    evaluation.ok = !evaluation.values.empty(); // an empty list: failed
    if (evaluation.ok) {
      const auto behind = evaluation.values.end() - static_cast<std::ptrdiff_t>(pieces_);
      evaluation.pieces.assign(behind, evaluation.values.end());
      evaluation.values.erase(behind, evaluation.values.end());
    }
    evaluation.status = evaluation.ok ? "ok" : "not_converged";
    evaluation.message = evaluation.ok ? "" : "made to fail";
    return evaluation;
  }

  std::optional<std::size_t> pieces_of() const override {
    return pieces_ > 0 ? std::optional<std::size_t>(0) : std::nullopt;
  }

  std::atomic<int> calls = 0;

private:
  Function function_;
  std::size_t pieces_;
  std::vector<std::string> names_;
  std::vector<Response> responses_;
};

struct Box {
  double lower, upper, start;
};

inline DesignSpace box_design(const std::vector<Box>& box) {
  static const std::vector<std::string> paths = [] {
    std::vector<std::string> all;
    for (const char* member : {"flexspline", "circular_spline"})
      for (const char* key :
           {"tip_relief_um", "root_relief_um", "crowning_um", "slope_um", "lead_crowning_um"})
        all.push_back(std::string("flank_modification.") + member + "." + key);
    return all;
  }();
  std::vector<DesignVariable> variables;
  for (std::size_t i = 0; i < box.size(); ++i)
    variables.push_back({.path = NumberPath(paths[i]),
                         .lower = box[i].lower,
                         .upper = box[i].upper,
                         .start = box[i].start,
                         .links = {}});
  return DesignSpace(std::move(variables));
}

/// A minimisation with g_k ≤ 0 and a known answer.
struct KnownProblem {
  std::string name;
  std::vector<Box> box;
  FunctionEvaluator::Function function; ///< f, g0, g1, …
  std::size_t limits = 0;
  double least = 0.0; ///< f at the answer
  bool smooth = true;
  bool narrow_valley = false; ///< a linear model creeps along it
};

/// With one minimum each.
std::vector<KnownProblem> known_problems();
/// With several, of which the start's own is not the deepest.
std::vector<KnownProblem> known_global_problems();

/// All limits g_k ≤ 0, everything scaled by 1.
inline Problem make_problem(const KnownProblem& known, Evaluator& evaluator) {
  std::vector<Constraint> constraints;
  for (std::size_t k = 0; k < known.limits; ++k)
    constraints.push_back({.output = limit_name(k),
                           .min = {},
                           .max = 0.0,
                           .min_ratio_to_baseline = {},
                           .max_ratio_to_baseline = {}});
  Evaluation baseline;
  baseline.ok = true;
  baseline.values.assign(1 + known.limits, 0.0);
  return Problem(box_design(known.box), evaluator, {.output = "f"}, constraints, baseline);
}

} // namespace strainwave
