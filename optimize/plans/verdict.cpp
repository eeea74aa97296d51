#include "strainwave/optimize/plans/verdict.hpp"

#include "strainwave/optimize/methods/nlopt_search.hpp"
#include "strainwave/optimize/plans/descent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

/// Of each coordinate's range: large against the tolerance, small against the valleys of a landscape.
constexpr double confirmation_step = 0.01;

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double p, double q) { return p == q || (std::isnan(p) && std::isnan(q)); });
}

std::string violations(const Problem& problem, const Evaluation& evaluation) {
  std::string list;
  for (const Limit& limit : problem.limits()) {
    const double value = evaluation.values[limit.response];
    if (limit.scaled_excess(value) <= feasibility_tolerance)
      continue;
    const Response& response = problem.evaluator().responses()[limit.response];
    list += fmt::format("{}{} is {:.6g}{}{} and has to be at {} {:.6g}", list.empty() ? "" : "; ",
                        response.name, value, response.unit.empty() ? "" : " ", response.unit,
                        limit.upper ? "most" : "least", limit.bound);
  }
  return list;
}

} // namespace

std::string_view verdict_name(Verdict verdict) {
  switch (verdict) {
  case Verdict::converged:
    return "converged";
  case Verdict::stalled:
    return "stalled";
  case Verdict::budget:
    return "budget";
  case Verdict::infeasible:
    return "infeasible";
  case Verdict::stopped:
    return "stopped";
  }
  return "unknown";
}

namespace {

/// Adds what a small search found and asked.
void take_over(SearchResult& found, const SearchResult& again) {
  found.asked += again.asked;
  found.failed += again.failed;
  found.seen.insert(found.seen.end(), again.seen.begin(), again.seen.end());
  if (again.best && better(*again.best, *found.best))
    found.best = again.best;
}

/// A simplex, then gradient sampling at two radii. True: both came to their end, without a failed evaluation.
bool look_around(const Problem& problem, SearchResult& found, const SearchSettings& settings,
                 std::size_t budget, Monitor& monitor) {
  SearchSettings small = settings;
  small.method = "cobyla";
  small.first_step = std::max(confirmation_step, 2.0 * settings.tolerance);
  small.budget = budget;
  const SearchResult simplex = search_nlopt(problem, found.best->y, small, monitor);
  take_over(found, simplex);
  found.end = simplex.end;
  if (simplex.failed > 0 || simplex.end != SearchEnd::tolerance)
    return false;
  Recorder recorder(problem, budget - simplex.asked, monitor);
  try {
    const SearchPoint from = *found.best;
    for (const double radius : {confirmation_step, 0.1 * confirmation_step})
      (void)find_descent(problem, from, radius, settings.seed,
                         [&](std::span<const double> y) { return recorder.evaluate(y); });
  } catch (const Recorder::Ended& end) {
    found.end = end.end;
  }
  const SearchResult& sampled = recorder.result();
  take_over(found, sampled);
  return sampled.failed == 0 && found.end == SearchEnd::tolerance;
}

} // namespace

bool confirm(const Problem& problem, SearchResult& found, const SearchSettings& settings, std::size_t budget,
             Monitor& monitor) {
  const std::size_t limit = found.asked + budget;
  while (found.best) {
    const SearchPoint before = *found.best;
    if (!look_around(problem, found, settings, limit - found.asked, monitor))
      return false;
    const bool same_kind = feasible(before) == feasible(*found.best);
    const double gain = feasible(before) ? before.objective - found.best->objective
                                         : before.violation - found.best->violation;
    if (same_kind && gain <= settings.tolerance * std::max(1.0, std::abs(before.objective)))
      return true;
  }
  return false;
}

Judgement judge(const Problem& problem, const SearchResult& found, bool confirmed, Evaluator& fresh) {
  Judgement judgement;
  const auto say = [&](Verdict verdict, std::string message) {
    judgement.verdict = verdict;
    judgement.message = std::move(message);
    return judgement;
  };
  if (!found.best) {
    if (found.end == SearchEnd::stopped)
      return say(Verdict::stopped, "stopped before a design was evaluated");
    return say(Verdict::infeasible,
               fmt::format("all {} evaluations failed; the last one: {}", found.asked, found.reason));
  }
  const std::vector<double> x = problem.design().unscaled(found.best->y);
  const Evaluation again = fresh.evaluate(x);
  const Evaluation first = problem.evaluator().evaluate(x);
  judgement.fresh = again;
  judgement.best = problem.read(found.best->y, again);
  if (!judgement.best->ok)
    return say(Verdict::stalled,
               fmt::format("the optimum does not stand: evaluated again it failed ({})", again.message));
  if (!same_bits(first.values, again.values))
    return say(Verdict::stalled, "the optimum does not stand: evaluated again it gives other numbers");
  if (found.end == SearchEnd::stopped)
    return say(Verdict::stopped,
               "stopped before its end (time limit or signal); this is the best design so far");
  if (!feasible(*judgement.best))
    return say(Verdict::infeasible,
               "no design keeps all limits; nearest to it: " + violations(problem, again));
  if (!again.certificate.holds())
    return say(Verdict::stalled,
               "the optimum does not stand: its residuals are too large; see the certificate");
  if (found.end == SearchEnd::budget)
    return say(Verdict::budget,
               fmt::format("{} evaluations were used up before the search came to rest", found.asked));
  if (found.end != SearchEnd::tolerance)
    return say(Verdict::stalled, "the method gave up before it came to rest");
  if (!confirmed)
    return say(Verdict::stalled, "evaluations near the optimum failed, so nothing confirms that it is one");
  return say(Verdict::converged,
             "searches around the optimum find nothing better; evaluated again it gives the same "
             "numbers and keeps all limits");
}

} // namespace strainwave
