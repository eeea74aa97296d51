#include "strainwave/studies/commands/kinds.hpp"

#include "strainwave/model/results/response.hpp"
#include "strainwave/optimize/plans/optimise.hpp"
#include "strainwave/studies/file/study_gear.hpp"
#include "strainwave/studies/sweep/sweep.hpp"
#include "strainwave/studies/tolerances/monte_carlo.hpp"
#include "strainwave/studies/tolerances/outputs.hpp"
#include "strainwave/studies/tolerances/sensitivity.hpp"

#include <stdexcept>

namespace strainwave {

StudyVocabulary study_vocabulary() {
  return {.outputs = gear_response_names(),
          .methods = method_names(),
          .sampled_outputs = sampled_response_names(),
          .unavailable = [](std::string_view output, const StudyFile& study) {
            return find_unavailable_response(output, study.gear, study_loads(study));
          }};
}

Outcome<SampledStudy> make_rows(const StudyFile& study, const RowOptions& options) {
  switch (study.kind) {
  case StudyKind::sweep:
    return make_sweep_rows(study, options);
  case StudyKind::monte_carlo:
    return make_monte_carlo_rows(study, options);
  case StudyKind::sensitivity:
    return make_sensitivity_rows(study, options);
  default:
    throw std::logic_error("the points of a search are not known in advance");
  }
}

} // namespace strainwave
