#pragma once
// One search from one starting point: what every method gets and gives, whichever library it comes from.

#include "strainwave/optimize/methods/monitor.hpp"
#include "strainwave/optimize/problem/problem.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace strainwave {

/// Why a search came to its end; whether its best point is any good is decided elsewhere (verdict.hpp).
enum class SearchEnd {
  tolerance, ///< the method is content
  budget,    ///< as many points asked for as were allowed
  stalled,   ///< the method gave up: rounding errors, or no way on
  stopped,   ///< from outside
  all_failed ///< the first evaluations all failed
};

struct SearchSettings {
  std::string method = "cobyla";
  std::size_t budget = 200; ///< points asked for, repeated ones included
  double tolerance = 1e-4;  ///< of the scaled coordinates and, relative, of the objective
  double first_step = 0.2;  ///< share of the range of each coordinate
  std::uint64_t seed = 1;
};

struct SearchResult {
  SearchEnd end = SearchEnd::tolerance;
  std::optional<SearchPoint> best; ///< feasible if any was; else the least violation; nothing if all failed
  std::size_t asked = 0;
  std::size_t failed = 0;
  std::string reason;            ///< of the last failed evaluation
  std::vector<SearchPoint> seen; ///< every point that did not fail, in the order of asking
};

/// After so many failed evaluations without a single good one a search ends with all_failed.
inline constexpr std::size_t all_failed_limit = 20;

/// What a method is told about the points it asks for. It keeps the best one itself, because a library's own
/// idea of the best is not to be relied on.
///
/// A failed evaluation never reaches a method as NaN, which several of them take for success. The method is
/// told finite numbers worse than all that it has seen: the worst objective plus the spread seen plus 1, and
/// every constraint violated by 1 more than ever. (An extreme barrier: Audet and Dennis, SIAM J. Optim. 17,
/// 2006, made finite.) The numbers depend on this search alone, so that several searches at once stay
/// reproducible.
class Recorder {
public:
  Recorder(const Problem& problem, std::size_t budget, Monitor& monitor)
      : problem_(problem), budget_(budget), monitor_(monitor) {}

  struct Told {
    double objective = 0.0;
    std::vector<double> constraint;
    std::vector<double> objective_slopes, constraint_slopes; ///< as in Slopes; only after ask_slopes
    bool ok = false;
  };

  /// Thrown instead of another evaluation.
  struct Ended {
    SearchEnd end;
  };

  /// The same point twice in a row is one question.
  const Told& ask(std::span<const double> y);
  /// With first derivatives. Where they are not to be had, those of the last point that had some.
  const Told& ask_slopes(std::span<const double> y);
  /// The point itself, whatever became of it; for those who can deal with failed ones.
  SearchPoint evaluate(std::span<const double> y, Evaluation* whole = nullptr);
  const SearchResult& result() const { return result_; }

private:
  void tell(const SearchPoint& point);

  const Problem& problem_;
  std::size_t budget_;
  Monitor& monitor_;
  SearchResult result_;
  SearchPoint last_;
  bool slopes_known_ = false; ///< at last_
  Told told_;
  double best_objective_ = 0.0, worst_objective_ = 0.0;
  std::vector<double> worst_constraint_;
};

} // namespace strainwave
