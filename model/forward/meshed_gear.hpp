#pragma once
// One gear with its cup on the wave generator, at any meshing phase: the stages from assembly to phase model
// composed. Nothing changes after construction; what a phase needs is made when it is asked for, once. Const
// functions may be called by several threads.

#include "strainwave/common/threads/memo.hpp"
#include "strainwave/model/forward/shared_stages.hpp"
#include "strainwave/model/loading/phase_model.hpp"

#include <memory>
#include <vector>

namespace strainwave {

class MountedCup {
public:
  MountedCup(std::shared_ptr<SharedStages> stages, const Gear& gear,
             std::shared_ptr<const NeutralCurve> curve, std::shared_ptr<const Ring> ring, StageInput input,
             double disc_shift_mm);

  const Gear& gear() const { return gear_; }
  const NeutralCurve& curve() const { return *curve_; }
  const Ring& ring() const { return *ring_; }
  const WaveGeneratorSurface& surface() const { return surface_; }
  /// Of contact.reference_section_mm.
  double disc_shift_mm() const { return disc_shift_mm_; }
  Outcome<std::shared_ptr<const AssembledState>> assembly(MeshingPhase phase) const;

private:
  std::shared_ptr<SharedStages> stages_;
  Gear gear_;
  std::shared_ptr<const NeutralCurve> curve_;
  std::shared_ptr<const Ring> ring_;
  StageInput input_;
  double disc_shift_mm_;
  WaveGeneratorSurface surface_;
  /// Those of this gear, held: what analyses share may be dropped meanwhile.
  mutable Memo<MeshingPhase, Outcome<std::shared_ptr<const AssembledState>>> assemblies_{64};
};

/// By how much the discs have to move outwards for the neutral surface to stand at u0 in the reference
/// section (secant method); 0 without one. `reused` stays true as long as every assembly was known.
Outcome<double> disc_shift(SharedStages& stages, const Gear& gear, const StageInput& input,
                           const RingCompliance& ring, const NeutralCurve& curve, bool& reused);

class MeshedGear {
public:
  /// flanks: one pair for each slice of the responses.
  MeshedGear(std::shared_ptr<const MountedCup> cup, std::vector<FlankPair> flanks);

  const Gear& gear() const { return cup_->gear(); }
  const MountedCup& cup() const { return *cup_; }
  const std::vector<FlankPair>& flanks() const { return flanks_; }
  /// Those on drive flanks.
  Outcome<std::vector<LoadedPoint>> points(MeshingPhase phase) const;
  Outcome<std::shared_ptr<const PhaseModel>> phase_model(MeshingPhase phase) const;

private:
  Outcome<std::vector<LoadedPoint>> points_at(MeshingPhase phase) const;
  Outcome<std::shared_ptr<const PhaseModel>> model_at(MeshingPhase phase) const;

  std::shared_ptr<const MountedCup> cup_;
  std::vector<FlankPair> flanks_;
  mutable Memo<MeshingPhase, Outcome<std::vector<LoadedPoint>>> points_{64};
  mutable Memo<MeshingPhase, Outcome<std::shared_ptr<const PhaseModel>>> models_{64}; ///< some MB each
};

} // namespace strainwave
