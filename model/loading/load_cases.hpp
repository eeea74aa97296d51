#pragma once
// From phases to responses: every load of the gear at every meshing phase, the worst of them, transmission
// error, stiffness and lost motion, and the certificate over all of it.
//
// Coast is the mirrored problem φ → −φ: phase s of the coast side is phase 1 − s of the drive side with tooth
// −1 − i for tooth i (s = 0: phase 0 and tooth −i), so only drive problems are ever solved.

#include "strainwave/model/loading/phase_model.hpp"
#include "strainwave/model/meshing/meshing_phase.hpp"
#include "strainwave/model/results/result.hpp"

#include <functional>

namespace strainwave {

/// Tooth whose mirror image φ → −φ a tooth is; phase: of either side.
int mirrored_tooth(int tooth, MeshingPhase phase);

/// The drive problem at a meshing phase; made on demand and kept for the analysis.
using PhaseSource = std::function<Outcome<std::shared_ptr<const PhaseModel>>(MeshingPhase phase)>;

/// One load as it has been solved, for those who want more of it than the result holds.
struct SolvedLoad {
  enum class Use { load_case, rated, small };
  Use use = Use::load_case;
  std::size_t load_case = 0; ///< its place in ForwardResult::load
  Direction direction = Direction::drive;
  MeshingPhase model_phase; ///< that PhaseSource was asked for
  Control control = Control::torque;
  std::shared_ptr<const PhaseModel> model;
  PhaseLoad load;
};
using LoadObserver = std::function<void(const SolvedLoad&)>;

/// Fills load, stiffness and the contact part of the certificate of `result`; a Failure when a load has no
/// solution.
std::optional<Failure> solve_load_cases(const Gear& gear, const PhaseSource& phase_source,
                                        ForwardResult& result, const LoadObserver& observer = {});

} // namespace strainwave
