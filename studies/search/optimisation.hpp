#pragma once
// Runs a study of kind "optimize" or "pareto": from the file to judged optima beside the unmodified gear.

#include "strainwave/common/threads/run_context.hpp"
#include "strainwave/optimize/gear/gear_bound.hpp"
#include "strainwave/optimize/gear/gear_evaluator.hpp"
#include "strainwave/optimize/plans/optimise.hpp"
#include "strainwave/optimize/problem/evaluation_store.hpp"
#include "strainwave/studies/search/search.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace strainwave {

struct RunOptions {
  RunContext context = {};
  std::filesystem::path journal = {}; ///< kept there and answered from there; empty: nothing is kept
  std::function<void(const SearchProgress&)> progress = {};
};

/// A number of the gear before and after, by its path.
struct InputChange {
  std::string path;
  std::string_view unit;
  double baseline = 0.0;
  double best = 0.0;
  std::string link; ///< "3 · wave_generator.max_radial_deformation_mm" for a number that moves along
};

struct LimitReport {
  Limit limit;
  std::string origin; ///< "0.95 × unmodified"; empty for a plain number
};

/// One design of a front.
struct FrontPoint {
  std::optional<double> bound; ///< of the second aim; nothing at the end where the objective alone counts
  Verdict verdict = Verdict::stalled;
  std::string message;
  std::vector<InputChange> inputs;
  std::optional<Evaluation> outputs;
};

/// Failed evaluations of one kind.
struct FailureCount {
  std::string status;
  std::size_t count = 0;
  std::string example; ///< the sentence of one of them
};

/// What no clearance of single teeth could beat, beside the optimum (optimize/gear/gear_bound.hpp).
struct BoundReport {
  GearBound bound;           ///< of the load whose bound lies nearest below its optimum
  double optimum_n = 0.0;    ///< peak force of that load
  std::string rotation_from; ///< what allows the rotation: "the limit" or "the optimum's own"
};

/// The unmodified gear and the optimum under a changed model (variants.hpp).
struct ModelVariant {
  std::string name;
  Evaluation baseline, best;
};

struct OptimisationReport {
  StudyFile study;
  std::string method;
  Verdict verdict = Verdict::stalled;
  std::string message;
  EvaluationCounts counts;
  double seconds = 0.0;
  std::vector<InputChange> inputs; ///< variables first, then linked numbers
  Evaluation baseline;
  std::optional<Evaluation> best; ///< by a fresh evaluation; nothing if no design could be evaluated
  std::optional<Gear> best_gear;  ///< with the study's loads and phases in its [load]
  std::vector<LimitReport> limits;
  std::optional<BoundReport> bound;   ///< least peak_force_n with torques only
  std::string no_bound;               ///< why there is none, where one could be expected
  std::vector<ModelVariant> variants; ///< optimize; the study's own model first
  std::vector<FrontPoint> front;      ///< pareto; `best` is its first design then
  Certificate certificate_worst;
  std::string damage;              ///< tail of the journal that was cut; empty: none
  std::string too_many_failed;     ///< one sentence where more evaluations failed than the study allows
  std::vector<StoredPoint> points; ///< all evaluations, ascending in x, so that no number of threads shows
};

/// By status, the most frequent first.
std::vector<FailureCount> count_failures(const std::vector<StoredPoint>& points);

DesignSpace study_design(const StudyFile& study);

/// Throws FieldError where the study asks for what cannot be (a ratio to a baseline of 0). A baseline without
/// a result, or one that interferes, is no baseline: Outcome's Failure.
Outcome<OptimisationReport> run_optimisation(const StudyFile& study, const RunOptions& options);

} // namespace strainwave
