#include "strainwave/model/forward/ring_pair.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/flexspline/response_store.hpp"
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
PoseSource pose_source(const NominalMesh& mesh, const RingCompliance& ring, const NeutralCurve& curve,
                       const AssembledState& assembled, std::shared_ptr<AssembledPoses>& keep) {
  if (mesh.gear.contact.gaps != GapModel::assembled)
    return [&curve](int, double phi, int) { return curve.pose(phi); };
  keep = std::make_shared<AssembledPoses>(ring, assembled, mesh.gear.flexspline.neutral_radius_mm, 0.0,
                                          slice_places(*mesh.responses));
  return [keep](int sector, double phi, int slice) { return keep->pose(sector, phi, slice); };
}

std::vector<Pose> poses_of(const NominalMesh& mesh, const PoseSource& source) {
  std::vector<Pose> poses;
  for (const LoadedPoint& tooth : mesh.teeth)
    poses.push_back(source(tooth.tooth, own_lobe(tooth.phi_rad), 0));
  return poses;
}

/// −d of assembly: what the unloaded wall forces do to the teeth's gaps.
Eigen::VectorXd assembly_shift(const NominalMesh& mesh, const AssembledState& assembled) {
  return mesh.half->tooth_displacement(tooth_functionals(*mesh.half, mesh.teeth), assembled.stations,
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

Outcome<NominalMesh> nominal_mesh(ForwardModel& model, const Gear& gear, const ForwardOptions& options) {
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
  auto curve = NeutralCurve::make(gear.wave_generator, gear.flexspline);
  if (!curve)
    return curve.failure();
  const ResponseStore store(options.disk_cache ? cache_folder() : std::filesystem::path());
  auto stored = stored_unit_responses(response_request(gear), store, options.threads);
  if (!stored)
    return stored.failure();
  auto responses = std::make_shared<const UnitResponses>(std::move(stored).value().responses);
  auto ring = std::make_shared<const RingCompliance>(*responses, contact_rows(gear), false);
  const double shift = analysis.assembly->disc_shift_mm;
  NominalMesh mesh{.gear = gear,
                   .analysis = std::move(analysis),
                   .curve = *curve,
                   .responses = responses,
                   .ring = ring,
                   .half = gear.flexspline.teeth % 2 == 0
                               ? std::make_shared<const RingCompliance>(*responses, contact_rows(gear), true)
                               : ring,
                   .surface = surface_of(gear, *curve, shift),
                   .assembled = {},
                   .teeth = {},
                   .pose = {},
                   .disc_shift_mm = shift};
  if (gear.wave_generator.shape == WaveGeneratorShape::four_force) {
    const double angle = *gear.wave_generator.force_angle_deg * pi / 180.0;
    mesh.assembled = hold_at_lines(*ring, angle, mesh.curve.displacement(angle).u_mm, 0.0);
  } else {
    ContactSolver solver;
    auto assembled = assemble(*ring, mesh.surface, 0.0, solver);
    if (!assembled)
      return assembled.failure();
    mesh.assembled = std::move(assembled).value();
  }

  auto table = backlash(gear, mesh.curve, 0.0);
  if (!table)
    return table.failure();
  Backlash ring_table = std::move(table).value();
  if (gear.flexspline.teeth % 2 == 0)
    add_second_lobe(ring_table, gear.flexspline.teeth);
  auto pair = FlankPair::make(gear);
  if (!pair)
    return pair.failure();
  std::shared_ptr<AssembledPoses> keep;
  const PoseSource source = pose_source(mesh, *mesh.ring, mesh.curve, mesh.assembled, keep);
  mesh.teeth = flank_points(gear, *responses, ring_table, {*pair}, source);
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
  auto curve = NeutralCurve::make(gear.wave_generator, gear.flexspline);
  if (!curve)
    return curve.failure();
  MeshAtDiscs result;
  const bool loose = gear.contact.fidelity != Fidelity::linear;
  AssembledState assembled;
  if (loose || gear.contact.gaps == GapModel::assembled) {
    ContactSolver solver;
    auto solved = assemble(*mesh.half, surface_of(gear, *curve, mesh.disc_shift_mm), 0.0, solver);
    if (!solved)
      return solved.failure();
    assembled = std::move(solved).value();
  }
  std::shared_ptr<AssembledPoses> keep;
  result.pose = poses_of(mesh, pose_source(mesh, *mesh.half, *curve, assembled, keep));
  result.tooth_shift_mm.assign(mesh.teeth.size(), 0.0);
  if (loose) {
    const Eigen::VectorXd shift = assembly_shift(mesh, assembled);
    result.tooth_shift_mm.assign(shift.begin(), shift.end());
  }
  return result;
}

} // namespace strainwave
