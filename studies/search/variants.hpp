#pragma once
// An optimum seen through other models: does what was gained in one of them stand in the next? The optimised
// gear and the unmodified one are analysed again with one choice of the model changed at a time:
//
//     the other fidelity     unilateral ↔ linear
//     the other gap model    kinematic ↔ assembled
//     twice the phases       between the ones that the search looked at

#include "strainwave/studies/search/optimisation.hpp"

namespace strainwave {

/// One entry for each change; numbers are absent where the gear has no result then.
std::vector<ModelVariant> optimum_variants(const Gear& baseline, const Gear& best,
                                           const std::vector<Load>& loads, const ForwardModel& model);

} // namespace strainwave
