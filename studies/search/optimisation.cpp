#include "strainwave/studies/search/optimisation.hpp"

#include "strainwave/optimize/plans/pareto.hpp"
#include "strainwave/studies/file/study_gear.hpp"
#include "strainwave/studies/results/result_folder.hpp"
#include "strainwave/studies/search/bound.hpp"
#include "strainwave/studies/search/journal.hpp"
#include "strainwave/studies/search/results_file.hpp"
#include "strainwave/studies/search/variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace strainwave {

namespace {

/// Interfering flanks have no unloaded state to compare with.
std::optional<Failure> find_fault_of_baseline(const Evaluation& baseline) {
  if (!baseline.ok)
    return Failure{Status::contradiction, "the unmodified gear has no result: " + baseline.message};
  const auto index = find_response(gear_responses(), "min_backlash_um");
  const double backlash_um = baseline.values[*index];
  if (backlash_um >= 0.0)
    return std::nullopt;
  return Failure{
      Status::contradiction,
      fmt::format("the unmodified gear interferes (least backlash {:.3f} µm) and is no baseline; raise "
                  "circular_spline.profile_shift in [override] until it is free",
                  backlash_um)};
}

std::vector<Constraint> constraints_of(const StudyFile& study) {
  std::vector<Constraint> constraints;
  for (const StudyConstraint& c : study.part<SearchPart>().constraints)
    constraints.push_back({.output = c.output,
                           .min = c.min,
                           .max = c.max,
                           .min_ratio_to_baseline = c.min_ratio_to_baseline,
                           .max_ratio_to_baseline = c.max_ratio_to_baseline});
  return constraints;
}

/// In the order in which Problem makes limits of constraints.
std::vector<LimitReport> limits_of(const StudyFile& study, const Problem& problem) {
  std::vector<LimitReport> reports;
  std::size_t k = 0;
  for (const StudyConstraint& c : study.part<SearchPart>().constraints) {
    for (const auto& plain : {c.min, c.max})
      if (plain)
        reports.push_back({problem.limits()[k++], ""});
    for (const auto& ratio : {c.min_ratio_to_baseline, c.max_ratio_to_baseline})
      if (ratio)
        reports.push_back({problem.limits()[k++], fmt::format("{} × unmodified", shortest(*ratio))});
  }
  return reports;
}

std::vector<InputChange> inputs_of(const DesignSpace& design, const Gear& before, const Gear& after) {
  std::vector<InputChange> inputs;
  const auto add = [&](const NumberPath& path, std::string link) {
    inputs.push_back({path.path(), path.field().unit, path.get(before), path.get(after), std::move(link)});
  };
  for (const DesignVariable& v : design.variables())
    add(v.path, "");
  for (const DesignVariable& v : design.variables())
    for (const LinkedNumber& link : v.links)
      add(link.path, fmt::format("{} · {}", shortest(link.ratio), v.path.path()));
  return inputs;
}

/// The unmodified gear as a design, if it lies within the bounds.
std::vector<std::vector<double>> unmodified(const DesignSpace& design, const Gear& gear) {
  const std::vector<double> y = design.scaled(design.read(gear)), upper = design.scaled_upper();
  for (std::size_t i = 0; i < y.size(); ++i)
    if (!(y[i] >= 0.0 && y[i] <= upper[i]))
      return {};
  return {y};
}

/// The gear of a judged design, and its numbers beside the unmodified ones.
Gear gear_of(const OptimisationReport& report, const DesignSpace& design, const Judgement& judgement) {
  if (!judgement.fresh || !judgement.fresh->ok)
    return report.study.gear;
  Gear gear = design.apply(report.study.gear, design.unscaled(judgement.best->y));
  gear.name = report.study.gear.name + ", optimised";
  gear.load = gear_with_loads(report.study).load;
  return gear;
}

void report_best(OptimisationReport& report, const DesignSpace& design, const Judgement& judgement) {
  report.verdict = judgement.verdict;
  report.message = judgement.message;
  const Gear gear = gear_of(report, design, judgement);
  report.inputs = inputs_of(design, report.study.gear, gear);
  if (!judgement.fresh || !judgement.fresh->ok)
    return;
  report.best = judgement.fresh;
  report.best_gear = gear;
}

/// The verdict on a front is the worst of its points.
void report_front(OptimisationReport& report, const DesignSpace& design,
                  const std::vector<ParetoPoint>& front) {
  report_best(report, design, front.front().judgement);
  for (const ParetoPoint& point : front) {
    const Judgement& j = point.judgement;
    report.front.push_back({.bound = point.bound,
                            .verdict = j.verdict,
                            .message = j.message,
                            .inputs = inputs_of(design, report.study.gear, gear_of(report, design, j)),
                            .outputs = j.fresh && j.fresh->ok ? j.fresh : std::nullopt});
    if (j.verdict > report.verdict) {
      report.verdict = j.verdict;
      report.message = j.message;
    }
  }
  if (report.verdict == Verdict::converged)
    report.message = "every point: " + report.message;
}

void note_failures(OptimisationReport& report) {
  const double share = report.study.limits.failure_share;
  const auto points = static_cast<double>(report.points.size());
  if (static_cast<double>(report.counts.failed) > share * points)
    report.too_many_failed =
        fmt::format("{} of {} evaluations failed, more than the share of {} that the study allows",
                    report.counts.failed, report.points.size(), shortest(share));
}

} // namespace

std::vector<FailureCount> count_failures(const std::vector<StoredPoint>& points) {
  std::vector<FailureCount> counts;
  for (const StoredPoint& point : points) {
    const Evaluation& e = *point.evaluation;
    if (e.ok)
      continue;
    auto known = std::find_if(counts.begin(), counts.end(),
                              [&](const FailureCount& c) { return c.status == e.status; });
    if (known == counts.end())
      known = counts.insert(counts.end(), {e.status, 0, e.message});
    ++known->count;
  }
  std::stable_sort(counts.begin(), counts.end(),
                   [](const FailureCount& a, const FailureCount& b) { return a.count > b.count; });
  return counts;
}

DesignSpace study_design(const StudyFile& study) {
  std::vector<DesignVariable> variables;
  for (const StudyVariable& v : study.part<SearchPart>().variables) {
    const NumberPath path(v.path);
    DesignVariable variable{.path = path,
                            .lower = v.lower,
                            .upper = v.upper,
                            .start = v.start ? *v.start : std::clamp(path.get(study.gear), v.lower, v.upper),
                            .scale = v.scale.value_or(0.0),
                            .links = {}};
    if (v.link)
      variable.links.push_back({NumberPath(v.link->path), v.link->ratio});
    variables.push_back(std::move(variable));
  }
  return DesignSpace(std::move(variables));
}

Outcome<OptimisationReport> run_optimisation(const StudyFile& study, const RunOptions& options) {
  const RunContext& context = options.context;
  const auto begin = std::chrono::steady_clock::now();
  const DesignSpace design = study_design(study);
  const std::vector<Load> loads = study_loads(study);
  const ForwardOptions forward_options{.disk_cache = context.disk_cache, .threads = context.threads};
  const auto forward = std::make_shared<const ForwardModel>(forward_options);
  GearEvaluator model(study.gear, design, loads, forward, context.warn);
  OptimisationReport report;
  report.study = study;
  const auto& search = study.part<SearchPart>();
  report.method = search.method.name.empty() ? std::string(global_method) : search.method.name;
  report.baseline = model.evaluate_base();
  if (auto fault = find_fault_of_baseline(report.baseline))
    return *fault;

  EvaluationStore store(model);
  std::optional<SearchJournal> journal;
  if (!options.journal.empty()) {
    journal.emplace(options.journal, plan_hash(study), search_model_hash(), store);
    report.damage = journal->damage();
  }
  const Objective objective{search.objective.output, search.objective.goal == Goal::maximise};
  const Problem problem(design, store, objective, constraints_of(study), report.baseline);
  report.limits = limits_of(study, problem);
  // At least one new evaluation in every run: else runs shorter than the baseline would never come to an end.
  const auto stop = [&] { return context.stop && context.stop() && store.counts().done > 0; };
  Monitor monitor(static_cast<std::size_t>(search.method.budget), stop, options.progress);
  GearEvaluator fresh(study.gear, design, loads, forward_options); // shares nothing with the search
  const OptimiseSettings settings{.search = {.method = report.method,
                                             .budget = static_cast<std::size_t>(search.method.budget),
                                             .tolerance = search.method.tolerance,
                                             .seed = static_cast<std::uint64_t>(study.seed)},
                                  .starts = static_cast<std::size_t>(search.method.starts),
                                  .threads = context.threads,
                                  .known = unmodified(design, study.gear)};
  if (const auto* two = study.find_part<ParetoPart>()) {
    const Objective second{two->pareto.output, two->pareto.goal == Goal::maximise};
    const auto points = static_cast<std::size_t>(two->pareto.points);
    const auto front = pareto_front(problem, second, {.each = settings, .points = points}, fresh, monitor);
    report_front(report, design, front);
  } else {
    report_best(report, design, optimise(problem, settings, fresh, monitor).judgement);
    report_bound(report, design, loads, *forward);
    if (report.best_gear && !(context.stop && context.stop()))
      report.variants = optimum_variants(report.study.gear, *report.best_gear, loads, *forward);
  }
  if (journal)
    journal->sync();
  report.counts = store.counts();
  report.certificate_worst = store.worst_certificate();
  report.points = store.points();
  std::stable_sort(report.points.begin(), report.points.end(),
                   [](const StoredPoint& a, const StoredPoint& b) { return a.x < b.x; });
  note_failures(report);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

} // namespace strainwave
