#include "strainwave/optimize/methods/nlopt_search.hpp"

#include "strainwave/optimize/methods/nlopt_methods.hpp"

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>

namespace strainwave {

namespace {

struct Destroy {
  void operator()(nlopt_opt opt) const { nlopt_destroy(opt); }
};
using Opt = std::unique_ptr<nlopt_opt_s, Destroy>;

SearchEnd end_of(nlopt_result code) {
  switch (code) {
  case NLOPT_OUT_OF_MEMORY:
    throw std::bad_alloc();
  case NLOPT_INVALID_ARGS:
    throw std::logic_error("NLopt refuses its arguments");
  case NLOPT_MAXEVAL_REACHED:
    return SearchEnd::budget;
  case NLOPT_SUCCESS:
  case NLOPT_FTOL_REACHED:
  case NLOPT_XTOL_REACHED:
    return SearchEnd::tolerance;
  default:
    return SearchEnd::stalled; // rounding errors and plain failure: the best point is in our own record
  }
}

void check(nlopt_result code) {
  if (code < 0)
    (void)end_of(code == NLOPT_FAILURE ? NLOPT_INVALID_ARGS : code);
}

/// Bounds, first step and tolerance, as all of them need.
Opt make_opt(nlopt_algorithm algorithm, const Problem& problem, const SearchSettings& settings,
             double tolerance) {
  const std::vector<double> upper = problem.design().scaled_upper();
  const std::vector<double> lower(upper.size(), 0.0);
  Opt opt(nlopt_create(algorithm, static_cast<unsigned>(upper.size())));
  if (!opt)
    throw std::bad_alloc();
  std::vector<double> step, small;
  for (const double range : upper) {
    step.push_back(settings.first_step * range);
    small.push_back(tolerance * range);
  }
  check(nlopt_set_lower_bounds(opt.get(), lower.data()));
  check(nlopt_set_upper_bounds(opt.get(), upper.data()));
  check(nlopt_set_initial_step(opt.get(), step.data()));
  check(nlopt_set_xtol_abs(opt.get(), small.data()));
  return opt;
}

/// The method, with the searches inside it where it needs them.
Opt make_method(const NloptMethod& method, const Problem& problem, const SearchSettings& settings) {
  Opt opt = make_opt(method.algorithm, problem, settings, settings.tolerance);
  if (method.needs_local) {
    const Opt local = make_opt(NLOPT_LN_BOBYQA, problem, settings, 10.0 * settings.tolerance);
    check(nlopt_set_maxeval(local.get(), 60 * static_cast<int>(problem.design().size())));
    check(nlopt_set_local_optimizer(opt.get(), local.get()));
  }
  if (problem.limits().empty() || method.takes_limits)
    return opt;
  // The multipliers move after every inner search, so each gets a share of the budget.
  check(nlopt_set_maxeval(opt.get(), static_cast<int>(std::max<std::size_t>(20, settings.budget / 8))));
  Opt outer = make_opt(NLOPT_AUGLAG, problem, settings, settings.tolerance);
  check(nlopt_set_local_optimizer(outer.get(), opt.get()));
  return outer;
}

/// One run of the library; its callbacks get a pointer to this.
class Run {
public:
  Run(const Problem& problem, const NloptMethod& method, const SearchSettings& settings, Monitor& monitor)
      : recorder_(problem, settings.budget, monitor), opt_(make_method(method, problem, settings)) {
    check(nlopt_set_min_objective(opt_.get(), objective, this));
    const std::size_t limits = problem.limits().size();
    if (limits == 0)
      return;
    const std::vector<double> slack(limits, 0.1 * feasibility_tolerance);
    check(nlopt_add_inequality_mconstraint(opt_.get(), static_cast<unsigned>(limits), constraints, this,
                                           slack.data()));
  }

  SearchResult from(std::span<const double> start) {
    std::vector<double> y(start.begin(), start.end());
    double least = 0.0;
    const nlopt_result code = nlopt_optimize(opt_.get(), y.data(), &least);
    if (thrown_)
      std::rethrow_exception(thrown_);
    SearchResult result = recorder_.result();
    result.end = ended_ ? *ended_ : end_of(code);
    return result;
  }

private:
  /// Runs `read` on what is known of y. Whatever is thrown stays here, and the library stops at its next
  /// opportunity.
  template <class Read>
  void guarded(const double* y, unsigned n, bool with_slopes, Read&& read) noexcept {
    if (thrown_ || ended_)
      return; // the library has not noticed yet
    try {
      read(with_slopes ? recorder_.ask_slopes({y, n}) : recorder_.ask({y, n}));
    } catch (const Recorder::Ended& end) {
      ended_ = end.end;
      nlopt_force_stop(opt_.get());
    } catch (...) {
      thrown_ = std::current_exception();
      nlopt_force_stop(opt_.get());
    }
  }

  static double objective(unsigned n, const double* y, double* slopes, void* data) {
    double value = 1e30; // finite, and of no consequence any more
    if (slopes)
      std::fill(slopes, slopes + n, 0.0);
    static_cast<Run*>(data)->guarded(y, n, slopes != nullptr, [&](const Recorder::Told& told) {
      value = told.objective;
      if (slopes)
        std::copy(told.objective_slopes.begin(), told.objective_slopes.end(), slopes);
    });
    return value;
  }

  static void constraints(unsigned m, double* values, unsigned n, const double* y, double* slopes,
                          void* data) {
    std::fill(values, values + m, 1e30);
    if (slopes)
      std::fill(slopes, slopes + std::size_t{m} * n, 0.0);
    static_cast<Run*>(data)->guarded(y, n, slopes != nullptr, [&](const Recorder::Told& told) {
      std::copy(told.constraint.begin(), told.constraint.end(), values);
      if (slopes)
        std::copy(told.constraint_slopes.begin(), told.constraint_slopes.end(), slopes);
    });
  }

  Recorder recorder_;
  Opt opt_;
  std::exception_ptr thrown_;
  std::optional<SearchEnd> ended_;
};

} // namespace

std::span<const std::string_view> nlopt_method_names() {
  static const auto names = [] {
    std::vector<std::string_view> all;
    for (const NloptMethod& method : nlopt_method_table())
      all.push_back(method.name);
    return all;
  }();
  return names;
}

SearchResult search_nlopt(const Problem& problem, std::span<const double> y, const SearchSettings& settings,
                          Monitor& monitor) {
  const NloptMethod* method = find_nlopt_method(settings.method);
  if (!method)
    throw std::logic_error("there is no NLopt method " + settings.method);
  nlopt_srand(static_cast<unsigned long>(settings.seed));
  return Run(problem, *method, settings, monitor).from(y);
}

} // namespace strainwave
