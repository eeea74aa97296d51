#include "strainwave/studies/commands/kinds.hpp"

#include "strainwave/studies/convergence/convergence.hpp"
#include "strainwave/studies/search/search.hpp"
#include "strainwave/studies/sweep/sweep.hpp"
#include "strainwave/studies/tolerances/monte_carlo.hpp"
#include "strainwave/studies/tolerances/sensitivity.hpp"

#include <vector>

namespace strainwave {

StudyKinds study_kinds() {
  static const std::vector<const StudyKind*> kinds{
      &optimize_kind(),    //
      &pareto_kind(),      //
      &sweep_kind(),       //
      &monte_carlo_kind(), //
      &sensitivity_kind(), //
      &convergence_kind(), //
  };
  return kinds;
}

} // namespace strainwave
