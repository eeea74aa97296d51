#pragma once
// One run through the stages, with what a result says about it: times, what was reused, certificate, message.

#include "strainwave/model/forward/meshed_gear.hpp"
#include "strainwave/model/loading/load_cases.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace strainwave {

struct Ask {
  Want want = Want::load;
  /// Without what only people look at (backlash by tooth, compliance of the teeth), and with the solved
  /// loads.
  bool lean = false;
};

/// What a run has come to.
struct Run {
  ForwardResult result;
  std::shared_ptr<const MountedCup> cup;    ///< null before it is assembled
  std::shared_ptr<const MeshedGear> meshed; ///< null before its teeth are asked for
  std::vector<SolvedLoad> solved;           ///< lean only
};

/// Nothing is thrown for a gear that cannot be computed; status and message of the result stay as they are.
std::optional<Failure> run_stages(const std::shared_ptr<SharedStages>& stages, const Gear& gear,
                                  const Ask& ask, Run& run);

/// The same, and the result is complete: with status, message, and the stages that were skipped.
Run complete_run(const std::shared_ptr<SharedStages>& stages, const Gear& gear, const Ask& ask);

/// A compliance that is not positive definite is one that rounding has eaten up: data of this gear, not our
/// bug.
Failure ill_conditioned(const Gear& gear, const NotPositiveDefinite& error);

} // namespace strainwave
