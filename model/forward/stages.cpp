#include "strainwave/model/forward/stages.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/loading/load_cases.hpp"
#include "strainwave/model/meshing/assembled_backlash.hpp"
#include "strainwave/model/meshing/gear_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string_view>

namespace strainwave {

namespace {

using units::degree;
using Parts = std::vector<std::string_view>;

Parts curve_parts() {
  return {"wave_generator.shape",           "wave_generator.max_radial_deformation_mm",
          "wave_generator.eccentricity_mm", "wave_generator.wrap_angle_deg",
          "wave_generator.force_angle_deg", "wave_generator.table_file",
          "flexspline.neutral_radius_mm",   "flexspline.rim_thickness_mm"};
}
Parts response_parts() {
  return {"flexspline", "material", "mesh", "contact.flank_points", "contact.face_slices"};
}
Parts ring_parts() {
  Parts parts = response_parts();
  parts.push_back("wave_generator.contact_width_mm");
  return parts;
}
/// Beyond curve and ring.
Parts surface_parts() {
  return {"wave_generator.disc_taper_um", "contact.disc_gap"};
}

StageInput input_of(const Gear& gear, const Parts& parts) {
  StageInput input{part_of(gear, parts), {}};
  input.key.add(canonical_bits(gear, parts));
  return input;
}

/// D is symmetric by construction, so its own transpose proves nothing. Three of its columns (first, middle,
/// last tooth) are found again from a unit force and the reaction of the held wall, and compared with the
/// rows; relative.
double reciprocity_error(const RingCompliance& ring, const AssembledState& assembled,
                         const std::vector<LoadedPoint>& teeth, const Eigen::MatrixXd& d) {
  const std::vector<ToothFunctional> functionals = tooth_functionals(ring, teeth);
  double error = 0.0;
  for (const Eigen::Index j : {Eigen::Index{0}, d.rows() / 2, d.rows() - 1}) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(d.rows(), j);
    const Eigen::VectorXd column =
        ring.tooth_displacement(functionals, functionals, unit) -
        ring.tooth_displacement(functionals, assembled.stations,
                                frozen_reaction(ring, assembled, functionals, unit));
    error = std::max(error, (column.transpose() - d.row(j)).cwiseAbs().maxCoeff());
  }
  return error / d.cwiseAbs().maxCoeff();
}

} // namespace

StageInput curve_input(const Gear& gear) {
  StageInput input = input_of(gear, curve_parts());
  if (gear.wave_generator.shape == WaveGeneratorShape::table) {
    std::ifstream file(gear.wave_generator.table_file);
    input.key.add(std::string(std::istreambuf_iterator<char>(file), {}));
  }
  return input;
}

StageInput response_input(const Gear& gear) {
  return input_of(gear, response_parts());
}

StageInput ring_input(const Gear& gear, bool fold) {
  StageInput input = input_of(gear, ring_parts());
  input.key.add(fold ? 1.0 : 0.0);
  return input;
}

StageInput assembly_input(const Gear& gear, const StageInput& curve, const StageInput& ring) {
  Parts parts = surface_parts();
  StageInput input;
  input.key.add(curve.key.bits()).add(ring.key.bits()).add(canonical_bits(gear, parts));
  for (const Parts& more : {curve_parts(), ring_parts()})
    parts.insert(parts.end(), more.begin(), more.end());
  input.part = part_of(gear, parts);
  return input;
}

bool lobes_alike(const Gear& gear) {
  return gear.contact.lobes == 2 && gear.flexspline.teeth % 2 == 0;
}

Outcome<NeutralCurve> neutral_curve(const StageInput& input) {
  return NeutralCurve::make(input.part.wave_generator, input.part.flexspline);
}

Ring ring_of(const StageInput& input, std::shared_ptr<const UnitResponses> responses, bool fold) {
  RingCompliance compliance(*responses, contact_rows(input.part), fold);
  return {std::move(responses), std::move(compliance)};
}

Outcome<AssembledState> assembled_cup(const Gear& part, const RingCompliance& ring, const NeutralCurve& curve,
                                      double disc_shift_mm, MeshingPhase phase) {
  if (part.wave_generator.shape == WaveGeneratorShape::four_force) {
    const double angle = *part.wave_generator.force_angle_deg * degree;
    return hold_at_lines(ring, angle, curve.displacement(angle).u_mm, phase.value());
  }
  ContactSolver solver;
  return assemble(ring, surface_of(part, curve, disc_shift_mm), phase.value(), solver);
}

AssemblyResult describe_assembly(const AssembledState& a, const RingCompliance& ring, double disc_shift_mm) {
  AssemblyResult out{.contact_force_n = a.disc_force_n,
                     .contact_lo_deg = a.contact_lo_rad / degree,
                     .contact_hi_deg = a.contact_hi_rad / degree,
                     .disc_shift_mm = disc_shift_mm,
                     .newton_steps = a.newton_steps};
  const int middle_row = static_cast<int>(ring.rows_mm().size() / 2);
  for (std::size_t i = 0; i < a.stations.size(); ++i) // phase 0: a station stands on the major axis
    if (a.stations[i].row == middle_row && std::abs(a.stations[i].phi_rad) < 1e-9)
      out.radial_deformation_mm = a.displacement(static_cast<Eigen::Index>(i), 0);
  return out;
}

Outcome<std::vector<FlankPair>> flanks_at(const Gear& gear, const std::vector<double>& z_mm) {
  std::vector<FlankPair> flanks;
  for (const double z : z_mm) {
    auto pair = FlankPair::make(gear, face_coordinate(gear.flexspline, z));
    if (!pair)
      return pair.failure();
    flanks.push_back(std::move(pair).value());
  }
  return flanks;
}

PoseSource poses_of_teeth(const NeutralCurve& curve, const Ring& ring, const AssembledState* assembled,
                          double neutral_radius_mm, MeshingPhase phase) {
  if (!assembled)
    return [&curve](int, double phi, int) { return curve.pose(phi); };
  const auto poses = std::make_shared<const AssembledPoses>(ring.compliance, *assembled, neutral_radius_mm,
                                                            phase.value(), slice_places(*ring.responses));
  return [poses](int sector, double phi, int slice) { return poses->pose(sector, phi, slice); };
}

Outcome<std::vector<LoadedPoint>> drive_points(const Gear& gear, const UnitResponses& responses,
                                               const std::vector<FlankPair>& flanks, const PoseSource& pose,
                                               MeshingPhase phase) {
  std::vector<LoadedPoint> points =
      flank_points(gear, responses, teeth_of_window(gear, phase.value()), flanks, pose);
  if (gear.contact.lobes == 1)
    std::erase_if(points, [](const LoadedPoint& p) { return std::abs(p.phi_rad) > units::pi / 2; });
  if (points.empty())
    return Failure{Status::no_overlap,
                   "no flank of the flexspline reaches the circular spline in this window: "
                   "no tooth can carry load"};
  return points;
}

std::vector<LoadedPoint> coast_points(std::vector<LoadedPoint> points, MeshingPhase phase) {
  std::reverse(points.begin(), points.end());
  for (LoadedPoint& point : points) {
    point.tooth = mirrored_tooth(point.tooth, phase);
    point.phi_rad = 0.0 - point.phi_rad; // 0 − 0 has no sign
    point.coast = true;
  }
  return points;
}

Outcome<AssembledBacklash> backlash_as_assembled(const Gear& gear, const Ring& ring,
                                                 const AssembledState& assembled) {
  const std::vector<double> z = backlash_sections(gear.flexspline);
  const auto flanks = flanks_at(gear, z);
  if (!flanks)
    return flanks.failure();
  const AssembledPoses poses(ring.compliance, assembled, gear.flexspline.neutral_radius_mm, 0.0, z);
  std::vector<double> phi; // of one lobe; the other stands alike
  const Backlash teeth = teeth_of_window(gear, 0.0);
  for (std::size_t i = 0; i < teeth.tooth.size(); ++i)
    if (teeth.lobe[i] == 0)
      phi.push_back(teeth.phi_rad[i]);
  AssembledBacklash b = assembled_backlash(
      poses, *flanks, z, phi, static_cast<double>(gear.flexspline.teeth) / gear.circular_spline.teeth);
  b.interference = b.min_um < 0.0;
  return b;
}

ComplianceResult compliance_of_teeth(const RingCompliance& ring, const AssembledState& assembled,
                                     const std::vector<LoadedPoint>& points) {
  std::vector<LoadedPoint> of_teeth;
  for (const LoadedPoint& point : points) {
    if (of_teeth.empty() || of_teeth.back().tooth != point.tooth) {
      of_teeth.push_back(point);
    } else if (point.backlash_mm / point.contact_radius_mm <
               of_teeth.back().backlash_mm / of_teeth.back().contact_radius_mm) {
      of_teeth.back() = point;
    }
  }
  const Eigen::MatrixXd d = frozen_compliance(ring, assembled, tooth_functionals(ring, of_teeth));
  ComplianceResult out;
  for (const LoadedPoint& point : of_teeth)
    out.tooth.push_back(point.tooth);
  for (Eigen::Index i = 0; i < d.rows(); ++i) {
    out.matrix_um_per_n.emplace_back();
    for (Eigen::Index j = 0; j < d.cols(); ++j)
      out.matrix_um_per_n.back().push_back(1e3 * d(i, j));
  }
  out.reciprocity_error = reciprocity_error(ring, assembled, of_teeth, d);
  return out;
}

} // namespace strainwave
