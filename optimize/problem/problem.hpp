#pragma once
// What is wanted: one response made small (or large), others kept within limits. Everything scaled, so that 1
// means "as much as the unmodified gear has":
//
//     f(y) = ± value / |baseline value|          g_k(y) = ± (value − bound) / scale ≤ 0,
//
// scale = the larger of |bound| and |baseline value|, or 1 where both are zero. A limit may be given as a
// number or as a ratio to the baseline, which is the gear before any change.

#include "strainwave/optimize/problem/design.hpp"
#include "strainwave/optimize/problem/evaluator.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace strainwave {

struct Objective {
  std::string output;
  bool maximise = false;
};

/// At least one limit is given; a response may have two.
struct Constraint {
  std::string output;
  std::optional<double> min = {};
  std::optional<double> max = {};
  std::optional<double> min_ratio_to_baseline = {};
  std::optional<double> max_ratio_to_baseline = {};
};

/// One side of a constraint, with its number.
struct Limit {
  std::size_t response = 0;
  bool upper = false; ///< value ≤ bound; else value ≥ bound
  double bound = 0.0; ///< in the unit of the response
  double scale = 1.0;

  double scaled_excess(double value) const { return (upper ? value - bound : bound - value) / scale; }
};

struct Slopes;

/// A design as a search sees it.
struct SearchPoint {
  std::vector<double> y;          ///< scaled coordinates
  bool ok = false;                ///< false: the evaluation failed, and the rest means nothing
  double objective = 0.0;         ///< f, scaled; smaller is better
  std::vector<double> constraint; ///< g, scaled; above 0: violated
  double violation = 0.0;         ///< largest g, at least 0
};

/// Scaled excess that still counts as met.
inline constexpr double feasibility_tolerance = 1e-6;

inline bool feasible(const SearchPoint& point) {
  return point.ok && point.violation <= feasibility_tolerance;
}
/// Feasible before infeasible before failed; then by objective, or by violation.
bool better(const SearchPoint& a, const SearchPoint& b);

class Problem {
public:
  /// Throws FieldError for a name that the evaluator does not give, and for a ratio to a baseline of 0 or
  /// below. `baseline` holds the values of the unmodified design and must be ok.
  Problem(DesignSpace design, Evaluator& evaluator, Objective objective,
          std::span<const Constraint> constraints, const Evaluation& baseline);

  const DesignSpace& design() const { return design_; }
  Evaluator& evaluator() const { return *evaluator_; }
  std::span<const Limit> limits() const { return limits_; }
  std::size_t objective_response() const { return objective_; }
  bool maximise() const { return maximise_; }
  double objective_scale() const { return objective_scale_; }

  /// Thread-safe. A value that is not finite counts as a failed evaluation.
  SearchPoint at(std::span<const double> y) const;
  SearchPoint read(std::span<const double> y, const Evaluation& evaluation) const;
  /// First derivatives in scaled coordinates where the evaluator knows its gradient; see slopes.hpp.
  std::optional<Slopes> exact_slopes(std::span<const double> y) const;
  /// The objective in the unit of its response.
  double unscaled_objective(const SearchPoint& point) const;

  /// The same limits, another objective. Throws FieldError for a name that the evaluator does not give.
  Problem aiming_at(const Objective& objective) const;
  /// One more limit: the response at most `bound`, or at least where more of it is wanted.
  Problem limited(const Objective& response, double bound) const;
  /// The same problem asked of another evaluator with the same responses.
  Problem with(Evaluator& evaluator) const;

private:
  DesignSpace design_;
  Evaluator* evaluator_;
  std::size_t objective_ = 0;
  bool maximise_ = false;
  double objective_scale_ = 1.0;
  std::vector<Limit> limits_;
  std::vector<double> baseline_;
};

} // namespace strainwave
