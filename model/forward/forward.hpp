#pragma once
// The forward model: the stages in order, each a function of what it is handed (stages.hpp), with reuse by
// content.
//
//     kinematics → backlash ───────────────────────────────┐
//     flexspline (finite elements, on disk by content) ────┤
//                → assembly → compliance ──────────────────┴→ load → responses
//
// One ForwardModel serves any number of threads: analyses share what they have computed, whoever needs a
// stage that is being computed waits for it, and nothing else waits. Results depend on the gear alone, never
// on what was analysed before.

#include "strainwave/model/results/result.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace strainwave {

struct ContactStates;  // contact_forces.hpp
class ForwardSolution; // gradient.hpp
struct LoadPath;       // load_path.hpp
struct PhaseProblem;   // phase_problem.hpp
class SharedStages;    // shared_stages.hpp

struct ForwardOptions {
  bool disk_cache = true; ///< unit responses on disk, in the XDG cache directory
  int threads = 0;        ///< for the finite elements; 0: all cores
};

/// What this version cannot do for a gear beyond its backlash, as the status not_available.
std::optional<Failure> find_unavailable(const Gear& gear);

class ForwardModel {
public:
  explicit ForwardModel(ForwardOptions options = {});

  /// Never throws for a gear that cannot be computed: status and message say why. Throws std::system_error
  /// and std::bad_alloc for disk and memory, FieldError for a faulty wave_generator.table_file.
  ForwardResult analyze(const Gear& gear, Want want = Want::load) const;

  /// The same numbers for Want::load without what only people look at (backlash by tooth, compliance of the
  /// teeth); where the status is ok, `solution` is what the derivatives can be had from.
  ForwardResult analyze(const Gear& gear, std::shared_ptr<const ForwardSolution>& solution) const;

  /// The contact forces of the assembled cup and of every load of the gear, at phase 0 in the drive
  /// direction; reuses what analyses have computed.
  Outcome<ContactStates> contact_states(const Gear& gear) const;

  /// The torque–rotation curve from rest to the gear's largest load with every event on it, at phase 0 in the
  /// drive direction (load_path.hpp), each load beside its direct solution and that with the exact disc gap.
  Outcome<LoadPath> load_path(const Gear& gear) const;

  /// The contact problem of all drive points at every phase of the gear's [load].
  Outcome<std::vector<PhaseProblem>> phase_problems(const Gear& gear) const;
  /// Only its points; `load` stays empty.
  Outcome<std::vector<PhaseProblem>> phase_points(const Gear& gear) const;

  /// For those in this room who compose stages otherwise.
  const std::shared_ptr<SharedStages>& stages() const { return stages_; }

private:
  std::shared_ptr<SharedStages> stages_;
};

} // namespace strainwave
