#include "strainwave/model/slopes/gradient_phase.hpp"
#include "strainwave/model/meshing/flank_points.hpp"
#include "strainwave/model/slopes/gradient_detail.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strainwave {

using namespace slopes;

PhaseSlopes::PhaseSlopes(const SlopeInputs& inputs, std::shared_ptr<const AssembledState> assembled)
    : in_(inputs), assembled_(std::move(assembled)),
      count_(static_cast<Eigen::Index>(inputs.parameters.size())) {
  std::vector<Eigen::Index> index;
  for (std::size_t i = 0; i < assembled_->active.size(); ++i)
    if (assembled_->active[i])
      index.push_back(static_cast<Eigen::Index>(i));
  for (const Eigen::Index i : index)
    closed_.push_back(assembled_->stations[static_cast<std::size_t>(i)]);
  normal_ = assembled_->normal(index, Eigen::all);
  along_ = across_ = turn_ =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(index.size()), in_.surface_slopes.columns());
  if (in_.surface_slopes.columns() > 1 && !index.empty())
    solve_assembly();
}

/// The cup alone on the wave generator: gap(u) = 0 where it is closed.
void PhaseSlopes::solve_assembly() {
  const auto n = static_cast<Eigen::Index>(closed_.size());
  const Eigen::Index columns = in_.surface_slopes.columns();
  Eigen::VectorXd force(n), stiffness(n);
  StateChange change{.wall_displacement = Eigen::MatrixXd::Zero(2 * n, columns),
                     .wall_gap = Eigen::MatrixXd(n, columns),
                     .wall_turn_force = Eigen::MatrixXd(n, columns),
                     .tooth_gap = Eigen::MatrixXd(0, columns),
                     .torque = Eigen::RowVectorXd::Zero(columns)};
  Eigen::MatrixXd own_turn(n, columns);
  Eigen::Index k = 0;
  for (std::size_t i = 0; i < assembled_->active.size(); ++i) {
    if (!assembled_->active[i])
      continue;
    const auto at = static_cast<Eigen::Index>(i);
    const WallStation& s = assembled_->stations[i];
    const double w = assembled_->displacement(at, 0), v = assembled_->displacement(at, 1);
    force(k) = assembled_->force_n(at);
    stiffness(k) = force(k) * in_.surface.curvature(s.phi_rad, s.z_mm, w, v);
    for (Eigen::Index c = 0; c < columns; ++c) {
      const auto [gap, turn] = in_.surface_slopes.at(c, s.phi_rad, s.z_mm, w, v);
      change.wall_gap(k, c) = gap;
      change.wall_turn_force(k, c) = force(k) * turn;
    }
    ++k;
  }
  const ContactTangent tangent(
      {.wall_wall = in_.ring.wall_wall(twice(closed_), stacked(normal_, tangents(normal_))),
       .wall_tooth = Eigen::MatrixXd(2 * n, 0),
       .tooth_tooth = Eigen::MatrixXd(0, 0)},
      Eigen::VectorXd(0), stiffness);
  const StateAnswer answer = tangent.solve(change, ContactTangent::Held::rotation);
  along_ = answer.wall_normal;
  across_ = answer.wall_tangent;
  turn_ = force.cwiseInverse().asDiagonal() * across_;
}

Eigen::MatrixX2d PhaseSlopes::assembled_change(Eigen::Index column) const {
  const Eigen::MatrixX2d tangent = tangents(normal_);
  Eigen::MatrixX2d change(normal_.rows(), 2);
  for (Eigen::Index i = 0; i < change.rows(); ++i)
    change.row(i) = along_(i, column) * normal_.row(i) + across_(i, column) * tangent.row(i);
  return change;
}

Eigen::VectorXd PhaseSlopes::assembly_force() const {
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(count_);
  for (std::size_t c = 0; c < in_.surface_slopes.parameter().size(); ++c)
    slopes(in_.surface_slopes.parameter()[c]) =
        wall_resultant(closed_, assembled_change(static_cast<Eigen::Index>(c)))(0);
  return slopes;
}

std::vector<double> PhaseSlopes::radial(double z_mm) const {
  std::vector<double> slopes;
  const int sector = 0;
  for (Eigen::Index c = 0; c < in_.surface_slopes.columns(); ++c)
    slopes.push_back(
        in_.ring.section({&sector, 1}, z_mm, closed_, assembled_change(c), {}, Eigen::VectorXd())(0, 0));
  return slopes;
}

PoseSlopes kinematic_slopes(const NeutralCurve& curve, const std::vector<std::string>& parameters,
                            double phi_rad) {
  const PoseDerivatives pose = curve.pose_derivatives(phi_rad);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  PoseSlopes result{pose.value, Eigen::Matrix3Xd::Zero(3, count)};
  for (Eigen::Index j = 0; j < count; ++j) {
    const std::string& path = parameters[static_cast<std::size_t>(j)];
    const bool shape_number = path == curve.shape_number_path();
    if (!shape_number && path != "wave_generator.max_radial_deformation_mm")
      continue;
    const std::size_t by = shape_number ? by_shape_number : by_radial_deformation;
    const double unit = shape_number && path.ends_with("_deg") ? std::numbers::pi / 180.0 : 1.0;
    result.by.col(j) = unit * Eigen::Vector3d(pose.rho[by], pose.phi1[by], pose.normal_rotation[by]);
  }
  return result;
}

const Eigen::MatrixXd& PhaseSlopes::section(int tooth, double z_mm) const {
  const auto [found, fresh] = sections_.try_emplace({tooth, z_mm});
  Eigen::MatrixXd& section = found->second;
  if (!fresh)
    return section;
  const auto moving = static_cast<Eigen::Index>(in_.surface_slopes.parameter().size());
  section.resize(4, moving + 1);
  section.col(0) = in_.ring
                       .section({&tooth, 1}, z_mm, assembled_->stations, assembled_->force_components(), {},
                                Eigen::VectorXd())
                       .row(0)
                       .transpose();
  for (Eigen::Index c = 0; c < moving; ++c)
    section.col(c + 1) =
        in_.ring.section({&tooth, 1}, z_mm, closed_, assembled_change(c), {}, Eigen::VectorXd())
            .row(0)
            .transpose();
  return section;
}

PoseSlopes PhaseSlopes::standing(double phi_rad, const Eigen::MatrixXd& section) const {
  PoseSlopes result{{}, Eigen::Matrix3Xd::Zero(3, count_)};
  const double across = in_.gear.flexspline.neutral_radius_mm + section(UnitResponses::section_radial, 0);
  const double v = section(UnitResponses::section_circumferential, 0);
  const double rho = std::hypot(across, v), turn = std::atan2(v, across);
  result.value = {.rho_mm = rho,
                  .phi1_rad = phi_rad + turn,
                  .normal_rotation_rad = section(UnitResponses::section_rotation, 0) - turn};
  for (Eigen::Index c = 1; c < section.cols(); ++c) {
    const double du = section(UnitResponses::section_radial, c),
                 dv = section(UnitResponses::section_circumferential, c);
    const double dturn = (across * dv - v * du) / (rho * rho);
    result.by.col(in_.surface_slopes.parameter()[static_cast<std::size_t>(c) - 1]) = Eigen::Vector3d(
        (across * du + v * dv) / rho, dturn, section(UnitResponses::section_rotation, c) - dturn);
  }
  return result;
}

PoseSlopes PhaseSlopes::pose(const LoadedPoint& point) const {
  const double own =
      point.phi_rad > 0.5 * std::numbers::pi + 1e-9 ? point.phi_rad - std::numbers::pi : point.phi_rad;
  if (in_.gear.contact.gaps == GapModel::kinematic)
    return kinematic_slopes(in_.curve, in_.parameters, own);
  return standing(own, section(point.tooth, point.z_mm));
}

Eigen::VectorXd PhaseSlopes::assembled_backlash(double phi_rad, double z_mm) const {
  // Between the four nearest tooth centres, as AssembledPoses has it.
  const double pitch = 2.0 * std::numbers::pi / in_.ring.sectors();
  const int first = static_cast<int>(std::floor(phi_rad / pitch)) - 3;
  std::vector<double> angle;
  for (int k = 0; k < 8; ++k)
    angle.push_back(pitch * (first + k));
  Eigen::MatrixXd between;
  for (const auto& [k, weight] : lagrange_weights(angle, phi_rad)) {
    const Eigen::MatrixXd part = weight * section(first + k, z_mm);
    between = between.size() == 0 ? part : Eigen::MatrixXd(between + part);
  }
  const PoseSlopes at = standing(phi_rad, between);
  const double space = phi_rad * in_.gear.flexspline.teeth / in_.gear.circular_spline.teeth;
  const double zeta = face_coordinate(in_.gear.flexspline, z_mm);
  const ToothBacklash contact = FlankPair::make(in_.gear, zeta)->drive(at.value, space);
  return FlankSlopes(in_.gear, in_.parameters, zeta)
      .at(at, space, {.height = {}, .place = contact.place, .kink = contact.kink, .roll = contact.roll})
      .gap;
}

const PhaseSlopes::PointChange& PhaseSlopes::change(const LoadedPoint& point) const {
  const auto [found, fresh] =
      changes_.try_emplace({point.tooth, point.z_mm, point.flank_radius_mm, point.coast});
  if (!fresh)
    return found->second;
  const Flexspline& fs = in_.gear.flexspline;
  const double height = fs.tip_radius_mm - fs.root_radius_mm;
  const auto slice = static_cast<std::size_t>(std::max(0, point.slice));
  const PoseSlopes at = pose(point);
  const double own =
      point.phi_rad > 0.5 * std::numbers::pi + 1e-9 ? point.phi_rad - std::numbers::pi : point.phi_rad;
  const double space = own * fs.teeth / in_.gear.circular_spline.teeth;
  ContactSpot spot;
  spot.coast = point.coast;
  if (in_.gear.contact.flank_points == 1) {
    const ToothBacklash contact =
        point.coast ? in_.flanks[slice].coast(at.value, space) : in_.flanks[slice].drive(at.value, space);
    spot.place = contact.place;
    spot.kink = contact.kink;
    spot.roll = contact.roll;
  } else {
    if (point.level > 0) {
      const int heights = in_.gear.contact.flank_points;
      spot.height = gap_height(point.level, heights);
      spot.place = point.level + 1 == heights ? ContactPlace::flexspline_tip : ContactPlace::flank;
    } else { // the circular spline's tip edge, or the flexspline's root
      const bool root = point.flank_radius_mm <= fs.root_radius_mm + 1e-12 * height;
      spot.place = root ? ContactPlace::flexspline_root : ContactPlace::circular_spline_tip;
      const double base =
          0.5 * fs.module_mm * fs.teeth * std::cos(fs.pressure_angle_deg * std::numbers::pi / 180.0);
      spot.roll = std::sqrt(std::max(0.0, std::pow(point.flank_radius_mm / base, 2) - 1.0));
    }
  }
  const ContactSlopes slopes = in_.flank_slopes[slice].at(at, space, spot);
  PointChange& change = found->second;
  change.resize(4, count_);
  change.row(of_gap) = slopes.gap.transpose();
  change.row(of_radius) = slopes.radius.transpose();
  change.row(of_height) = height * slopes.height_slope.transpose();
  if (in_.gear.contact.direction_of_force() == ForceDirection::flank_normal)
    change.row(of_angle) = slopes.pressure_angle.transpose();
  else
    change.row(of_angle).setZero();
  return change;
}

Eigen::VectorXd PhaseSlopes::least_take_up(const std::vector<LoadedPoint>& points) const {
  const auto take_up = [](const LoadedPoint& p) { return p.backlash_mm / p.contact_radius_mm; };
  const auto least =
      std::min_element(points.begin(), points.end(),
                       [&](const LoadedPoint& a, const LoadedPoint& b) { return take_up(a) < take_up(b); });
  const PointChange& by = change(*least);
  return (by.row(of_gap) - take_up(*least) * by.row(of_radius)).transpose() / least->contact_radius_mm;
}

} // namespace strainwave
