#include "strainwave/model/forward/ring_pair.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/forward/shared_stages.hpp"
#include "strainwave/model/meshing/flank_points.hpp"
#include "strainwave/model/meshing/gear_surface.hpp"
#include "strainwave/model/tooth/backlash.hpp"

#include <fmt/format.h>

#include <cmath>

namespace strainwave {

namespace {

using units::pi;

/// The table of one lobe with its teeth on the second lobe added.
void add_second_lobe(Backlash& table, int z1) {
  const std::size_t n = table.tooth.size();
  for (std::size_t i = 0; i < n; ++i) {
    table.tooth.push_back(table.tooth[i] + z1 / 2);
    table.lobe.push_back(1);
    table.phi_rad.push_back(table.phi_rad[i] + pi);
    table.drive.push_back(table.drive[i]);
    table.coast.push_back(table.coast[i]);
  }
}

double own_lobe(double phi_rad) {
  return phi_rad > 0.5 * pi + 1e-12 ? phi_rad - pi : phi_rad;
}

/// Poses of teeth: of the neutral curve, or of the assembled cup in the middle of the face.
PoseSource pose_source(const NominalMesh& mesh, const Ring& ring, const NeutralCurve& curve,
                       const AssembledState& assembled) {
  const bool as_assembled = mesh.gear.contact.gaps == GapModel::assembled;
  return poses_of_teeth(curve, ring, as_assembled ? &assembled : nullptr,
                        mesh.gear.flexspline.neutral_radius_mm, MeshingPhase{});
}

/// A part of a ring, which it keeps alive.
std::shared_ptr<const RingCompliance> compliance_of(const std::shared_ptr<const Ring>& ring) {
  return {ring, &ring->compliance};
}

std::vector<Pose> poses_of(const NominalMesh& mesh, const PoseSource& source) {
  std::vector<Pose> poses;
  for (const LoadedPoint& tooth : mesh.teeth)
    poses.push_back(source(tooth.tooth, own_lobe(tooth.phi_rad), 0));
  return poses;
}

/// −d of assembly: what the unloaded wall forces do to the teeth's gaps.
Eigen::VectorXd assembly_shift(const NominalMesh& mesh, const AssembledState& assembled) {
  const RingCompliance& ring = mesh.half->compliance;
  return ring.tooth_displacement(tooth_functionals(ring, mesh.teeth), assembled.stations,
                                 assembled.force_components());
}

Gear on_discs(const Gear& gear, double u0_mm, double eccentricity_mm) {
  Gear changed = gear;
  changed.wave_generator.max_radial_deformation_mm = u0_mm;
  changed.wave_generator.eccentricity_mm = eccentricity_mm;
  changed.wave_generator.wrap_angle_deg.reset();
  return changed;
}

} // namespace

Outcome<NominalMesh> nominal_mesh(const ForwardModel& model, const Gear& gear) {
  if (gear.contact.flank_points > 1 || gear.contact.face_slices > 1) {
    return Failure{
        Status::not_available,
        fmt::format("tolerance samples have one contact point per tooth; contact.flank_points is {} and "
                    "contact.face_slices {}",
                    gear.contact.flank_points, gear.contact.face_slices)};
  }
  ForwardResult analysis = model.analyze(gear, Want::compliance);
  if (analysis.status != Status::ok)
    return Failure{analysis.status, analysis.message};
  // the stages of the analysis, on the whole ring
  SharedStages& stages = *model.stages();
  const bool alike = gear.flexspline.teeth % 2 == 0;
  const StageInput curve_in = curve_input(gear), whole_in = ring_input(gear, false);
  const auto curve = stages.curve(curve_in).value;
  if (!curve)
    return curve.failure();
  const auto responses = stages.responses(response_input(gear), analysis.warnings).value;
  if (!responses)
    return responses.failure();
  const auto whole = stages.ring(whole_in, *responses, false);
  const auto half = alike ? stages.ring(ring_input(gear, true), *responses, true) : whole;
  const double shift = analysis.assembly->disc_shift_mm;
  const auto assembled = stages
                             .assembly(assembly_input(gear, curve_in, whole_in), whole->compliance, **curve,
                                       shift, MeshingPhase{})
                             .value;
  if (!assembled)
    return assembled.failure();
  NominalMesh mesh{.gear = gear,
                   .analysis = std::move(analysis),
                   .curve = **curve,
                   .ring = compliance_of(whole),
                   .half = half,
                   .surface = surface_of(gear, **curve, shift),
                   .assembled = **assembled,
                   .teeth = {},
                   .pose = {},
                   .disc_shift_mm = shift};

  auto table = backlash(gear, mesh.curve, 0.0);
  if (!table)
    return table.failure();
  Backlash ring_table = std::move(table).value();
  if (alike)
    add_second_lobe(ring_table, gear.flexspline.teeth);
  auto pair = FlankPair::make(gear);
  if (!pair)
    return pair.failure();
  const PoseSource source = pose_source(mesh, *whole, mesh.curve, mesh.assembled);
  mesh.teeth = flank_points(gear, **responses, ring_table, {*pair}, source);
  if (gear.contact.lobes == 1)
    std::erase_if(mesh.teeth, [](const LoadedPoint& p) { return p.phi_rad > 0.5 * pi + 1e-12; });
  if (mesh.teeth.empty())
    return Failure{Status::no_overlap,
                   "no flank of the flexspline reaches the circular spline in this window"};
  mesh.pose = poses_of(mesh, source);
  return mesh;
}

namespace {

Outcome<ContactState> solved(ContactSolver& solver, const ContactProblem& problem, double value,
                             Control control, const ActiveSet& warm) {
  if (control == Control::torque)
    return solver.solve_torque(problem, 1e3 * value, warm);
  return solver.solve_at(problem, value, warm);
}

} // namespace

Outcome<LoadTangent> nominal_load(const NominalMesh& mesh, double value, Control control) {
  ContactSolver solver;
  if (mesh.gear.contact.fidelity == Fidelity::linear) {
    LoadProblem load = linear_problem(*mesh.ring, mesh.assembled, mesh.teeth);
    auto state = solved(solver, load.problem, value, control, {});
    if (!state)
      return state.failure();
    return LoadTangent{std::move(load.problem), std::move(state).value(), {}, false};
  }
  ChangedSurface changed;
  if (mesh.two_discs()) {
    changed = [&mesh](const DiscChange& change) {
      const CurveSummary& nominal = mesh.curve.summary();
      return discs_of(mesh.gear, *nominal.eccentricity_mm + mesh.disc_shift_mm + change.eccentricity_mm,
                      *nominal.disc_radius_mm + change.radius_mm);
    };
  }
  const LoadProblem load = unilateral_problem(*mesh.ring, mesh.assembled, mesh.teeth);
  ActiveSet warm(mesh.teeth.size(), 0);
  warm.insert(warm.end(), mesh.assembled.active.begin(), mesh.assembled.active.end());
  auto state = solved(solver, load.problem, value, control, warm);
  if (!state)
    return state.failure();
  if (mesh.gear.contact.disc_gap == DiscGap::linearised)
    return linear_tangent(mesh.assembled, load, *state, changed);
  auto exact = correct_to_exact_gap(*mesh.ring, mesh.surface, mesh.assembled, load, *state, control, solver);
  if (!exact)
    return exact.failure();
  return tangent_at(*mesh.ring, mesh.surface, mesh.assembled, load, *exact, changed);
}

Outcome<MeshAtDiscs> mesh_at_discs(const NominalMesh& mesh, double u0_mm, double eccentricity_mm) {
  const Gear gear = on_discs(mesh.gear, u0_mm, eccentricity_mm);
  auto curve = neutral_curve(curve_input(gear));
  if (!curve)
    return curve.failure();
  MeshAtDiscs result;
  const bool loose = gear.contact.fidelity != Fidelity::linear;
  AssembledState assembled;
  if (loose || gear.contact.gaps == GapModel::assembled) {
    auto solved = assembled_cup(gear, mesh.half->compliance, *curve, mesh.disc_shift_mm, MeshingPhase{});
    if (!solved)
      return solved.failure();
    assembled = std::move(solved).value();
  }
  result.pose = poses_of(mesh, pose_source(mesh, *mesh.half, *curve, assembled));
  result.tooth_shift_mm.assign(mesh.teeth.size(), 0.0);
  if (loose) {
    const Eigen::VectorXd shift = assembly_shift(mesh, assembled);
    result.tooth_shift_mm.assign(shift.begin(), shift.end());
  }
  return result;
}

} // namespace strainwave
