#pragma once
// One analysis on its way through the stages of the forward model, and what analyses share. Of forward.cpp
// and analysis_cup.cpp only; others use forward.hpp.

#include "strainwave/common/threads/stage_memory.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/forward/gradient.hpp"
#include "strainwave/model/loading/contact_forces.hpp"
#include "strainwave/model/loading/load_cases.hpp"
#include "strainwave/model/loading/phase_problem.hpp"
#include "strainwave/model/meshing/flank_points.hpp"
#include "strainwave/model/results/load_path.hpp"
#include "strainwave/model/tooth/backlash.hpp"

#include <chrono>
#include <map>
#include <numbers>
#include <optional>

namespace strainwave {

/// Times a stage and notes how it came about.
class StageClock {
public:
  StageClock(ForwardResult& result, std::string name)
      : result_(result), name_(std::move(name)), start_(std::chrono::steady_clock::now()) {}
  /// A stage that ends without done() has run and failed.
  ~StageClock() {
    if (!noted_)
      done(StageStatus::computed);
  }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;
  void done(StageStatus status) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    result_.stages.push_back({name_, spent.count(), status});
    noted_ = true;
  }

private:
  bool noted_ = false;
  ForwardResult& result_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
};

/// The ring keeps the responses that it refers to alive.
struct Ring {
  std::shared_ptr<const UnitResponses> responses;
  RingCompliance compliance;
};

struct ForwardModel::State {
  explicit State(ForwardOptions given) : options(given) {}
  ForwardOptions options;
  StageMemory<Outcome<NeutralCurve>> curves{64};
  StageMemory<Outcome<UnitResponses>> responses{8};
  StageMemory<Ring> rings{8};
  StageMemory<Outcome<AssembledState>> assemblies{64};
};

class Analysis {
public:
  Analysis(ForwardModel::State& state, const Gear& gear, Want want)
      : state_(state), gear_(gear), want_(want) {
    result_.gear = gear.name;
    result_.fidelity = gear.contact.fidelity;
  }

  ForwardResult run();
  /// Before run(): keep the solved loads for gradient().
  void keep_solution() { keep_ = true; }
  /// After a run() that kept its solution and came to its end.
  ForwardGradient gradient(std::span<const std::string> parameters);
  Outcome<ContactStates> contact_states();
  Outcome<LoadPath> load_path();
  Outcome<std::vector<PhaseProblem>> phase_problems(bool with_load);

private:
  Outcome<ContactStates> unguarded_contact_states();
  /// A compliance that is not positive definite is one that rounding has eaten up: data of this gear, not our
  /// bug.
  Failure ill_conditioned(const NotPositiveDefinite& error) const;
  std::optional<Failure> guarded_stages();
  std::optional<Failure> stages();
  std::optional<Failure> kinematics();
  std::optional<Failure> first_backlash();
  std::optional<Failure> flexspline();
  /// The cup on the wave generator at a meshing phase.
  Outcome<std::shared_ptr<const AssembledState>> assembly(double phase, bool* reused = nullptr);
  /// Moves the discs until the neutral surface stands at u0 in the reference section, by the secant method.
  std::optional<Failure> shift_discs(bool& reused);
  std::optional<Failure> first_assembly();
  std::optional<Failure> backlash_as_assembled();
  /// The points that can meet their spaces at a phase. lobes = 1: those of the first lobe only.
  Outcome<std::vector<LoadedPoint>> loaded_points(double phase);
  /// Those of the coast flanks: the mirror image φ → −φ of the drive points at the mirrored phase.
  Outcome<std::vector<LoadedPoint>> coast_points(double phase);
  std::optional<Failure> compliance();
  Outcome<std::shared_ptr<const PhaseModel>> phase_model(double phase);
  std::optional<Failure> load();

  /// The assembly at a phase that has been met, for gradient().
  std::shared_ptr<const AssembledState> known_assembly(double phase);

  static constexpr std::size_t most_phases_kept = 64;

  ForwardModel::State& state_;
  const Gear gear_;
  Want want_;
  ForwardResult result_;
  std::shared_ptr<const Outcome<NeutralCurve>> curve_;
  std::map<double, Backlash> tables_;
  bool fold_ = true;
  ContentKey curve_key_;
  ContentKey ring_key_;
  std::shared_ptr<const Ring> ring_;
  std::optional<WaveGeneratorSurface> surface_;
  double disc_shift_ = 0.0;
  std::vector<FlankPair> flanks_;                        ///< one for each slice
  std::map<double, std::vector<LoadedPoint>> points_of_; ///< drive, by phase
  std::map<double, std::shared_ptr<const PhaseModel>> phases_;
  bool keep_ = false;
  std::vector<SolvedLoad> solved_;
};

} // namespace strainwave
