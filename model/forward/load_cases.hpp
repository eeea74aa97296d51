#pragma once
// From phases to responses: every load of the gear at every meshing phase, the worst of them, transmission error,
// stiffness and lost motion, and the certificate over all of it.
//
// Coast is the mirrored problem φ → −φ: phase s of the coast side is phase 1 − s of the drive side with tooth −1 − i for
// tooth i (s = 0: phase 0 and tooth −i), so only drive problems are ever solved.

#include "model/forward/phase_model.hpp"
#include "model/forward/result.hpp"

#include <functional>

namespace strainwave {

/// Tooth whose mirror image φ → −φ a tooth is; phase: of either side.
int mirrored_tooth(int tooth, double phase);

/// The drive problem at meshing phase s ∈ [0, 1); made on demand and kept for the analysis.
using PhaseSource = std::function<Outcome<std::shared_ptr<const PhaseModel>>(double phase)>;

/// Fills load, stiffness and the contact part of the certificate of `result`; a Failure when a load has no solution.
std::optional<Failure> solve_load_cases(const Gear& gear, const PhaseSource& phase_source,
                                        ForwardResult& result);

} // namespace strainwave
