#pragma once
// The bound on the peak force beside an optimum: what is allowed, by which load, and the words for it.

#include "strainwave/studies/search/optimisation.hpp"

namespace strainwave {

/// Fills report.bound (or report.no_bound) for a least peak_force_n under torques in the drive direction;
/// else nothing. The rotation allowed is that of the study's limit on rotation_rad for the largest torque,
/// else the optimum's own. `model`: the search's own, which knows the cups already.
void report_bound(OptimisationReport& report, const DesignSpace& design, const std::vector<Load>& loads,
                  const ForwardModel& model);

/// One line for people, empty without a bound.
std::string bound_sentence(const OptimisationReport& report);

} // namespace strainwave
