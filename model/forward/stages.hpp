#pragma once
// The stages of the forward model as functions. Each is handed a part of the gear and the values of the
// stages before it, and nothing else:
//
//     curve ─────► backlash (backlash.hpp) ─────────────────────┐
//       │                                                       ▼
//       └──► assembly ─────► gaps: points on drive and coast flanks ─► phase model ─► loads (load_cases.hpp)
//               ▲
//     unit responses ─► ring
//
// The key of a stage whose value is remembered (shared_stages.hpp) is not written down anywhere: it is the
// exact bits of the part of the gear that the stage is handed. A number outside of that part is the default's
// there, so that it can change neither key nor value.

#include "strainwave/common/threads/content_key.hpp"
#include "strainwave/model/contact/assembly.hpp"
#include "strainwave/model/contact/load_problem.hpp"
#include "strainwave/model/flexspline/unit_responses.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/meshing/flank_points.hpp"
#include "strainwave/model/meshing/meshing_phase.hpp"
#include "strainwave/model/results/result.hpp"
#include "strainwave/model/tooth/backlash.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace strainwave {

/// What a stage reads of a gear: the keys that it names, everything else as in a default-constructed Gear.
struct StageInput {
  Gear part;
  ContentKey key; ///< its content; a table file counts by its text
};

/// Shape numbers of the wave generator, neutral radius and thickness of the rim.
StageInput curve_input(const Gear& gear);
/// Cup, material, mesh and how finely the flank is loaded; nothing of the wave generator.
StageInput response_input(const Gear& gear);
/// The same and contact_width_mm. fold: both lobes are alike, half of the ring is enough.
StageInput ring_input(const Gear& gear, bool fold);
/// Those of curve and ring, and what else the rigid surface is made of.
StageInput assembly_input(const Gear& gear, const StageInput& curve, const StageInput& ring);

/// Whether both lobes of a gear carry alike, so that its analyses fold the ring.
bool lobes_alike(const Gear& gear);

Outcome<NeutralCurve> neutral_curve(const StageInput& input);

/// The free cup as contact sees it; it keeps the responses that it refers to alive.
struct Ring {
  std::shared_ptr<const UnitResponses> responses;
  RingCompliance compliance;
};
Ring ring_of(const StageInput& input, std::shared_ptr<const UnitResponses> responses, bool fold);

/// The cup on its wave generator, or held at the lines of four forces. Discs stand disc_shift_mm further out.
Outcome<AssembledState> assembled_cup(const Gear& part, const RingCompliance& ring, const NeutralCurve& curve,
                                      double disc_shift_mm, MeshingPhase phase);

/// Numbers of the assembly at phase 0.
AssemblyResult describe_assembly(const AssembledState& assembled, const RingCompliance& ring,
                                 double disc_shift_mm);

/// Flanks at places along the axis.
Outcome<std::vector<FlankPair>> flanks_at(const Gear& gear, const std::vector<double>& z_mm);

/// Poses of the assembled cup at the slices of the responses (gaps = "assembled"), or, without an assembly,
/// of the neutral curve, which has to outlive them.
PoseSource poses_of_teeth(const NeutralCurve& curve, const Ring& ring, const AssembledState* assembled,
                          double neutral_radius_mm, MeshingPhase phase);

/// The drive points that can meet their spaces at a phase; lobes = 1: those of the first lobe only. flanks:
/// one pair for each slice. Failure: no_overlap.
Outcome<std::vector<LoadedPoint>> drive_points(const Gear& gear, const UnitResponses& responses,
                                               const std::vector<FlankPair>& flanks, const PoseSource& pose,
                                               MeshingPhase phase);

/// The coast points of a phase: the mirror image φ → −φ of the drive points of the mirrored phase.
std::vector<LoadedPoint> coast_points(std::vector<LoadedPoint> mirrored_drive, MeshingPhase phase);

/// Backlash over face and angle of the assembled cup, drive flank, phase 0.
Outcome<AssembledBacklash> backlash_as_assembled(const Gear& gear, const Ring& ring,
                                                 const AssembledState& assembled);

/// Compliance of the teeth of these points (each tooth by its point of least take-up) on the assembled cup.
ComplianceResult compliance_of_teeth(const RingCompliance& ring, const AssembledState& assembled,
                                     const std::vector<LoadedPoint>& points);

} // namespace strainwave
