#include "optimize/nlopt_search.hpp"

#include <nlopt.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>

namespace strainwave {

namespace {

struct Method {
  std::string_view name;
  nlopt_algorithm algorithm;
};

constexpr std::array methods{
    Method{"cobyla", NLOPT_LN_COBYLA},
};

struct Destroy {
  void operator()(nlopt_opt opt) const { nlopt_destroy(opt); }
};
using Opt = std::unique_ptr<nlopt_opt_s, Destroy>;

/// One run of the library; its callbacks get a pointer to this.
class Run {
public:
  Run(const Problem& problem, const Method& method, const SearchSettings& settings, Monitor& monitor)
      : recorder_(problem, settings.budget, monitor), limits_(problem.limits().size()),
        opt_(nlopt_create(method.algorithm, static_cast<unsigned>(problem.design().size()))) {
    if (!opt_)
      throw std::bad_alloc();
    const std::vector<double> upper = problem.design().scaled_upper();
    const std::vector<double> lower(upper.size(), 0.0);
    std::vector<double> step, tolerance;
    for (const double range : upper)
      step.push_back(settings.first_step * range);
    for (const double range : upper)
      tolerance.push_back(settings.tolerance * range);
    check(nlopt_set_lower_bounds(opt_.get(), lower.data()));
    check(nlopt_set_upper_bounds(opt_.get(), upper.data()));
    check(nlopt_set_initial_step(opt_.get(), step.data()));
    check(nlopt_set_xtol_abs(opt_.get(), tolerance.data()));
    check(nlopt_set_min_objective(opt_.get(), objective, this));
    if (limits_ > 0) {
      const std::vector<double> slack(limits_, 0.1 * feasibility_tolerance);
      check(nlopt_add_inequality_mconstraint(opt_.get(), static_cast<unsigned>(limits_), constraints, this,
                                             slack.data()));
    }
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
  static SearchEnd end_of(nlopt_result code) {
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

  static void check(nlopt_result code) {
    if (code < 0)
      (void)end_of(code == NLOPT_FAILURE ? NLOPT_INVALID_ARGS : code);
  }

  /// Runs `read` on what is known of y. Whatever is thrown stays here, and the library stops at its next
  /// opportunity.
  template <class Read>
  void guarded(const double* y, unsigned n, Read&& read) noexcept {
    if (thrown_ || ended_)
      return; // the library has not noticed yet
    try {
      read(recorder_.ask({y, n}));
    } catch (const Recorder::Ended& end) {
      ended_ = end.end;
      nlopt_force_stop(opt_.get());
    } catch (...) {
      thrown_ = std::current_exception();
      nlopt_force_stop(opt_.get());
    }
  }

  static double objective(unsigned n, const double* y, double*, void* data) {
    double value = 1e30; // finite, and of no consequence any more
    static_cast<Run*>(data)->guarded(y, n, [&](const Recorder::Told& told) { value = told.objective; });
    return value;
  }

  static void constraints(unsigned m, double* values, unsigned n, const double* y, double*, void* data) {
    std::fill(values, values + m, 1e30);
    static_cast<Run*>(data)->guarded(y, n, [&](const Recorder::Told& told) {
      std::copy(told.constraint.begin(), told.constraint.end(), values);
    });
  }

  Recorder recorder_;
  std::size_t limits_;
  Opt opt_;
  std::exception_ptr thrown_;
  std::optional<SearchEnd> ended_;
};

} // namespace

std::span<const std::string_view> nlopt_methods() {
  static const auto names = [] {
    std::array<std::string_view, methods.size()> all;
    std::transform(methods.begin(), methods.end(), all.begin(),
                   [](const Method& method) { return method.name; });
    return all;
  }();
  return names;
}

SearchResult search_nlopt(const Problem& problem, std::span<const double> y, const SearchSettings& settings,
                          Monitor& monitor) {
  const auto method = std::find_if(methods.begin(), methods.end(),
                                   [&](const Method& m) { return m.name == settings.method; });
  if (method == methods.end())
    throw std::logic_error("there is no NLopt method " + settings.method);
  nlopt_srand(static_cast<unsigned long>(settings.seed));
  return Run(problem, *method, settings, monitor).from(y);
}

} // namespace strainwave
