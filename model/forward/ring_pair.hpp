#pragma once
// What studies of many nearly equal gears need of the nominal one: the whole ring, both lobes with their own
// teeth, at meshing phase 0, and its contact linearised about a loaded state (load_tangent.hpp).
//
//     auto mesh = nominal_mesh(model, gear);        // finite elements and assembly, once
//     auto load = nominal_load(*mesh, 7.0);         // what sampled_contact.hpp starts from
//     auto discs = mesh_at_discs(*mesh, u0, e);     // the same gear on other discs: poses and assembled
//     displacement
//
// One contact point for each tooth. Teeth: material angles in (−90°, 270°], those of contact.window_deg and
// contact.lobes that overlap their space.

#include "strainwave/model/contact/load_tangent.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/forward/stages.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"

#include <memory>
#include <vector>

namespace strainwave {

struct NominalMesh {
  Gear gear;
  ForwardResult analysis; ///< of the gear up to its compliance: warnings, certificate
  NeutralCurve curve;
  std::shared_ptr<const RingCompliance> ring; ///< unfolded
  std::shared_ptr<const Ring> half; ///< folded where both lobes are alike, for assembly; else the same
  WaveGeneratorSurface surface;
  AssembledState assembled;
  std::vector<LoadedPoint> teeth; ///< ascending φ
  std::vector<Pose> pose;         ///< of each tooth in its own lobe
  double disc_shift_mm = 0.0;     ///< of contact.reference_section_mm; kept when the discs change

  bool two_discs() const { return curve.summary().disc_radius_mm.has_value(); }
};

/// From the stages of the model's analysis: no finite elements are solved for it again. Failures: those of
/// the forward model, not_available for more than one contact point per tooth.
Outcome<NominalMesh> nominal_mesh(const ForwardModel& model, const Gear& gear);

/// Contact of the mesh about its solution at this torque (> 0, all lobes, N·m) or rotation (rad). Fidelity
/// linear: teeth alone.
Outcome<LoadTangent> nominal_load(const NominalMesh& mesh, double value, Control control = Control::torque);

/// The same gear assembled on discs with other numbers.
struct MeshAtDiscs {
  std::vector<Pose> pose; ///< of each tooth of the mesh
  std::vector<double>
      tooth_shift_mm; ///< change of q that comes with assembly (−d_assembly), 0 for fidelity linear
};
Outcome<MeshAtDiscs> mesh_at_discs(const NominalMesh& mesh, double u0_mm, double eccentricity_mm);

} // namespace strainwave
