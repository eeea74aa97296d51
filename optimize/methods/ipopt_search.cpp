#include "strainwave/optimize/methods/ipopt_search.hpp"

#include "strainwave/optimize/methods/epigraph.hpp"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>

#include <algorithm>
#include <exception>
#include <mutex>
#include <stdexcept>

namespace strainwave {

namespace {

using Ipopt::Index;
using Ipopt::Number;

/// Held by the search that is inside the library.
std::mutex& inside_ipopt() {
  static std::mutex mutex;
  return mutex;
}

/// Unknowns: y, then t. Rows: pieces − t ≤ 0, then limits ≤ 0.
class EpigraphProblem : public Ipopt::TNLP {
public:
  EpigraphProblem(const Problem& problem, std::span<const double> start, std::size_t budget, Monitor& monitor)
      : problem_(problem), epigraph_(problem), recorder_(problem, budget, monitor), n_(start.size()),
        start_(start.begin(), start.end()) {}

  /// The first evaluation; false if it fails, and then there is nothing to begin with.
  bool begin() {
    return guarded([&] { return look(start_.data()); });
  }

  SearchResult result(SearchEnd end) const {
    if (thrown_)
      std::rethrow_exception(thrown_);
    SearchResult result = recorder_.result();
    result.end = ended_ ? *ended_ : end;
    return result;
  }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = static_cast<Index>(n_ + 1);
    m = static_cast<Index>(values_.size());
    jacobian = static_cast<Index>(values_.size() * n_ + pieces());
    hessian = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* lower, Number* upper, Index m, Number* g_lower,
                       Number* g_upper) override {
    const std::vector<double> range = problem_.design().scaled_upper();
    std::fill(lower, lower + n_, 0.0);
    std::copy(range.begin(), range.end(), upper);
    lower[n_] = -1e19;
    upper[n_] = 1e19;
    std::fill(g_lower, g_lower + m, -1e19);
    std::fill(g_upper, g_upper + m, 0.0);
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy(start_.begin(), start_.end(), x);
    x[n_] = *std::max_element(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(pieces()));
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = x[n_];
    return true;
  }

  bool eval_grad_f(Index, const Number*, bool, Number* gradient) override {
    std::fill(gradient, gradient + n_, 0.0);
    gradient[n_] = 1.0;
    return true;
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* rows) override {
    return guarded([&] {
      if (!look(x))
        return false;
      std::copy(values_.begin(), values_.end(), rows);
      for (std::size_t r = 0; r < pieces(); ++r)
        rows[r] -= x[n_];
      return true;
    });
  }

  bool eval_jac_g(Index, const Number* x, bool, Index, Index, Index* row, Index* column,
                  Number* entries) override {
    const std::size_t rows = values_.size();
    if (!entries) {
      for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t i = 0; i < n_; ++i) {
          *row++ = static_cast<Index>(r);
          *column++ = static_cast<Index>(i);
        }
      }
      for (std::size_t r = 0; r < pieces(); ++r) {
        *row++ = static_cast<Index>(r);
        *column++ = static_cast<Index>(n_);
      }
      return true;
    }
    return guarded([&] {
      if (!look(x))
        return false;
      if (!slopes_)
        slopes_ =
            epigraph_.slopes(inside(x), values_, [this](std::span<const double> y) { return evaluate(y); });
      if (!slopes_)
        return false;
      std::copy(slopes_->begin(), slopes_->end(), entries);
      std::fill(entries + rows * n_, entries + rows * n_ + pieces(), -1.0);
      return true;
    });
  }

  bool eval_h(Index, const Number*, bool, Number, Index, const Number*, bool, Index, Index*, Index*,
              Number*) override {
    return false; // limited memory
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number, Number,
                             Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    return !ended_ && !thrown_;
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*, Index,
                         const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {}

private:
  std::size_t pieces() const { return values_.size() - problem_.limits().size(); }

  /// Ipopt widens bounds by 1e-8; the point itself keeps them.
  std::vector<double> inside(const Number* x) const {
    std::vector<double> y(x, x + n_);
    const std::vector<double> upper = problem_.design().scaled_upper();
    for (std::size_t i = 0; i < n_; ++i)
      y[i] = std::clamp(y[i], 0.0, upper[i]);
    return y;
  }

  /// Outside the library's lock.
  Evaluation evaluate(std::span<const double> y) {
    struct Outside {
      Outside() { inside_ipopt().unlock(); }
      ~Outside() { inside_ipopt().lock(); }
    } outside;
    Evaluation whole;
    (void)recorder_.evaluate(y, &whole);
    return whole;
  }

  /// Values at x, kept for the next question about the same point. False: not to be had.
  bool look(const Number* x) {
    if (known_ && std::equal(x, x + n_, at_.begin()))
      return good_;
    at_.assign(x, x + n_);
    known_ = true;
    slopes_.reset();
    auto values = epigraph_.values(evaluate(inside(x)));
    good_ = values && (values_.empty() || values->size() == values_.size());
    if (good_)
      values_ = std::move(*values);
    return good_;
  }

  /// Nothing may fly through the library: exceptions are kept and the search ends.
  template <class Work>
  bool guarded(Work&& work) {
    if (ended_ || thrown_)
      return false;
    try {
      return work();
    } catch (const Recorder::Ended& end) {
      ended_ = end.end;
    } catch (...) {
      thrown_ = std::current_exception();
    }
    known_ = false;
    return false;
  }

  const Problem& problem_;
  Epigraph epigraph_;
  Recorder recorder_;
  std::size_t n_;
  std::vector<double> start_;
  bool known_ = false, good_ = false;
  std::vector<double> at_, values_;
  std::optional<std::vector<double>> slopes_;
  std::exception_ptr thrown_;
  std::optional<SearchEnd> ended_;
};

void set_options(Ipopt::OptionsList& options, const SearchSettings& settings) {
  options.SetIntegerValue("print_level", 0);
  options.SetStringValue("sb", "yes");
  options.SetStringValue("hessian_approximation", "limited-memory");
  options.SetIntegerValue("limited_memory_max_history", 20); // few unknowns: keep them all
  options.SetStringValue("mu_strategy", "adaptive");
  options.SetStringValue("nlp_scaling_method", "none"); // everything is scaled already
  options.SetNumericValue("tol", std::max(1e-9, 1e-2 * settings.tolerance));
  options.SetNumericValue("acceptable_tol", settings.tolerance);
  options.SetIntegerValue("acceptable_iter", 5);
  options.SetIntegerValue("max_iter", 300);
  options.SetNumericValue("mu_init", 1e-3);
  // Starts are good designs: do not push them away from their bounds and limits.
  for (const char* name : {"bound_push", "bound_frac", "slack_bound_push", "slack_bound_frac"})
    options.SetNumericValue(name, 1e-4);
}

} // namespace

bool ipopt_available() {
  return true;
}

SearchResult search_ipopt(const Problem& problem, std::span<const double> y, const SearchSettings& settings,
                          Monitor& monitor) {
  const std::lock_guard lock(inside_ipopt());
  const Ipopt::SmartPtr<EpigraphProblem> epigraph = new EpigraphProblem(problem, y, settings.budget, monitor);
  if (!epigraph->begin())
    return epigraph->result(SearchEnd::stalled);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  set_options(*application->Options(), settings);
  if (application->Initialize("") != Ipopt::Solve_Succeeded)
    throw std::logic_error("Ipopt refuses its options");
  switch (application->OptimizeTNLP(GetRawPtr(epigraph))) {
  case Ipopt::Solve_Succeeded:
  case Ipopt::Solved_To_Acceptable_Level:
  case Ipopt::Search_Direction_Becomes_Too_Small:
    return epigraph->result(SearchEnd::tolerance);
  case Ipopt::Insufficient_Memory:
    throw std::bad_alloc();
  default:
    return epigraph->result(SearchEnd::stalled);
  }
}

} // namespace strainwave
