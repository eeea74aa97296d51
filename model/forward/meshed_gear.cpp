#include "strainwave/model/forward/meshed_gear.hpp"

#include "strainwave/model/meshing/gear_surface.hpp"

#include <fmt/format.h>

#include <cmath>

namespace strainwave {

MountedCup::MountedCup(std::shared_ptr<SharedStages> stages, const Gear& gear,
                       std::shared_ptr<const NeutralCurve> curve, std::shared_ptr<const Ring> ring,
                       StageInput input, double disc_shift_mm)
    : stages_(std::move(stages)), gear_(gear), curve_(std::move(curve)), ring_(std::move(ring)),
      input_(std::move(input)), disc_shift_mm_(disc_shift_mm),
      surface_(surface_of(gear_, *curve_, disc_shift_mm)) {}

Outcome<std::shared_ptr<const AssembledState>> MountedCup::assembly(MeshingPhase phase) const {
  const auto found = assemblies_.get(phase, [&] {
    return stages_->assembly(input_, ring_->compliance, *curve_, disc_shift_mm_, phase).value;
  });
  return *found.value;
}

Outcome<double> disc_shift(SharedStages& stages, const Gear& gear, const StageInput& input,
                           const RingCompliance& ring, const NeutralCurve& curve, bool& reused) {
  if (!gear.contact.reference_section_mm)
    return 0.0;
  constexpr double tolerance_mm = 1e-9;
  double shift = 0.0, before = 0.0, excess_before = 0.0;
  for (int step = 0; step < 30; ++step) {
    const auto assembled = stages.assembly(input, ring, curve, shift, MeshingPhase{});
    reused = reused && assembled.reused;
    if (!assembled.value)
      return assembled.value.failure();
    const AssembledPoses poses(ring, **assembled.value, gear.flexspline.neutral_radius_mm, 0.0,
                               {*gear.contact.reference_section_mm});
    const double excess = poses.radial(0.0, 0) - gear.wave_generator.max_radial_deformation_mm;
    if (std::abs(excess) < tolerance_mm)
      return shift;
    const double slope = step > 0 ? (excess - excess_before) / (shift - before) : 1.0;
    before = shift;
    excess_before = excess;
    shift -= excess / slope;
    if (!(std::abs(shift) < 0.2 * gear.flexspline.neutral_radius_mm))
      break; // slope lost
  }
  return Failure{Status::not_converged,
                 fmt::format("no shift of the discs brings the section at z = {} mm to u0 = {} mm",
                             *gear.contact.reference_section_mm,
                             gear.wave_generator.max_radial_deformation_mm)};
}

MeshedGear::MeshedGear(std::shared_ptr<const MountedCup> cup, std::vector<FlankPair> flanks)
    : cup_(std::move(cup)), flanks_(std::move(flanks)) {}

Outcome<std::vector<LoadedPoint>> MeshedGear::points(MeshingPhase phase) const {
  const auto found = points_.get(phase, [&] { return points_at(phase); });
  return *found.value;
}

Outcome<std::vector<LoadedPoint>> MeshedGear::points_at(MeshingPhase phase) const {
  std::shared_ptr<const AssembledState> assembled;
  if (gear().contact.gaps == GapModel::assembled) {
    auto found = cup_->assembly(phase);
    if (!found)
      return found.failure();
    assembled = std::move(found).value();
  }
  const PoseSource pose = poses_of_teeth(cup_->curve(), cup_->ring(), assembled.get(),
                                         gear().flexspline.neutral_radius_mm, phase);
  return drive_points(gear(), *cup_->ring().responses, flanks_, pose, phase);
}

Outcome<std::shared_ptr<const PhaseModel>> MeshedGear::phase_model(MeshingPhase phase) const {
  const auto found = models_.get(phase, [&] { return model_at(phase); });
  return *found.value;
}

Outcome<std::shared_ptr<const PhaseModel>> MeshedGear::model_at(MeshingPhase phase) const {
  auto drive = points(phase);
  if (!drive)
    return drive.failure();
  auto mirrored = points(phase.mirrored());
  if (!mirrored)
    return mirrored.failure();
  auto assembled = cup_->assembly(phase);
  if (!assembled)
    return assembled.failure();
  return std::make_shared<const PhaseModel>(gear().contact, cup_->ring().compliance, cup_->surface(),
                                            std::move(assembled).value(), std::move(drive).value(),
                                            coast_points(std::move(mirrored).value(), phase));
}

} // namespace strainwave
