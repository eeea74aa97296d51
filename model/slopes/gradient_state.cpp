// PhaseSlopes::of: the loaded state. Notation and equations: gradient_phase.hpp, contact_tangent.hpp.

#include "strainwave/model/slopes/gradient_detail.hpp"
#include "strainwave/model/slopes/gradient_phase.hpp"

#include <algorithm>
#include <cmath>

namespace strainwave {

using namespace slopes;

namespace {

/// A functional that changes with a number of one point: its contact height or its direction.
struct Moving {
  Eigen::Index tooth; ///< position among the closed points
  Line line;
};

void append(ToothFunctional& to, const ToothFunctional& from, double factor) {
  for (const auto& [index, weight] : from.weights)
    to.weights.emplace_back(index, factor * weight);
}

/// d functional / d flank radius: functionals are linear between two heights and constant beyond the ends.
ToothFunctional by_height(const RingCompliance& ring, const LoadedPoint& point, double circumferential,
                          double inwards, FlankSide side) {
  const std::vector<double>& heights = ring.responses().flank_radius_mm;
  ToothFunctional result{point.tooth, {}};
  if (heights.size() < 2 || point.flank_radius_mm < heights.front() || point.flank_radius_mm > heights.back())
    return result;
  auto upper = std::upper_bound(heights.begin(), heights.end(), point.flank_radius_mm) - heights.begin();
  upper = std::clamp<std::ptrdiff_t>(upper, 1, static_cast<std::ptrdiff_t>(heights.size()) - 1);
  const double lo = heights[static_cast<std::size_t>(upper) - 1],
               hi = heights[static_cast<std::size_t>(upper)];
  append(result, ring.tooth(point.tooth, hi, circumferential, inwards, point.slice, side), 1.0 / (hi - lo));
  append(result, ring.tooth(point.tooth, lo, circumferential, inwards, point.slice, side), -1.0 / (hi - lo));
  return result;
}

} // namespace

/// The closed sets of a loaded state.
struct PhaseSlopes::Closed {
  std::vector<Eigen::Index> index; ///< into the points
  std::vector<LoadedPoint> points;
  Eigen::VectorXd force, r;
  Eigen::MatrixXd change[4]; ///< by Line: closed points × parameters
  std::vector<WallStation> stations;
  Eigen::MatrixX2d normal;
  Eigen::VectorXd wall_force; ///< λ along the normals
};

PhaseLoadSlopes PhaseSlopes::of(const std::vector<LoadedPoint>& points, const std::vector<double>& force_n,
                                const PhaseLoad& load, Control control) const {
  const RingCompliance& ring = in_.ring;
  const bool linear = in_.gear.contact.fidelity == Fidelity::linear;
  PhaseLoadSlopes result;
  result.force_n = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(points.size()), count_);
  for (auto* slopes :
       {&result.rotation_rad, &result.torque_nm, &result.tangent_nm_per_rad, &result.disc_force_n})
    *slopes = Eigen::VectorXd::Zero(count_);

  Closed at;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(force_n[i] > 0.0))
      continue;
    at.index.push_back(static_cast<Eigen::Index>(i));
    at.points.push_back(points[i]);
  }
  const auto teeth = static_cast<Eigen::Index>(at.points.size());
  at.force.resize(teeth);
  at.r.resize(teeth);
  for (Eigen::MatrixXd& change : at.change)
    change.resize(teeth, count_);
  Eigen::VectorXd cosine(teeth), sine(teeth), side(teeth);
  for (Eigen::Index k = 0; k < teeth; ++k) {
    const LoadedPoint& point = at.points[static_cast<std::size_t>(k)];
    at.force(k) = force_n[static_cast<std::size_t>(at.index[static_cast<std::size_t>(k)])];
    cosine(k) = std::cos(point.pressure_angle_rad);
    side(k) = point.coast ? -1.0 : 1.0; // of the lever arm and of the circumferential direction
    sine(k) = std::sin(point.pressure_angle_rad);
    at.r(k) = side(k) * point.contact_radius_mm * cosine(k);
    const PointChange& by = change(point);
    for (int line = 0; line < 4; ++line)
      at.change[line].row(k) = by.row(line);
  }

  // Wall: the frozen set of the assembly with its reaction, or what carries force now.
  const Eigen::MatrixX2d since_assembly = load.wall_force - assembled_->force_components();
  std::vector<Eigen::Index> station;
  for (Eigen::Index i = 0; i < load.wall_force.rows(); ++i) {
    const bool closed = linear ? assembled_->active[static_cast<std::size_t>(i)] != 0
                               : load.wall_force(i, 0) != 0.0 || load.wall_force(i, 1) != 0.0;
    if (!closed)
      continue;
    station.push_back(i);
    at.stations.push_back(assembled_->stations[static_cast<std::size_t>(i)]);
  }
  const bool held_lines = assembled_->hold.size() > 0;
  const auto walls = held_lines ? assembled_->hold.rows() : static_cast<Eigen::Index>(station.size());
  at.wall_force.resize(walls);
  at.normal.resize(static_cast<Eigen::Index>(station.size()), 2);
  for (Eigen::Index j = 0; j < at.normal.rows(); ++j) {
    const Eigen::Index i = station[static_cast<std::size_t>(j)];
    if (linear) {
      at.normal.row(j) = assembled_->normal.row(i);
      at.wall_force(j) = since_assembly.row(i).dot(at.normal.row(j));
    } else {
      at.wall_force(j) = load.wall_force.row(i).norm();
      at.normal.row(j) = load.wall_force.row(i) / at.wall_force(j);
    }
  }

  // Functionals of the closed points, then those by which they change.
  std::vector<ToothFunctional> functionals = tooth_functionals(ring, at.points);
  std::vector<Moving> moving;
  for (Eigen::Index k = 0; k < teeth; ++k) {
    const LoadedPoint& point = at.points[static_cast<std::size_t>(k)];
    const FlankSide flank = point.coast ? FlankSide::coast : FlankSide::drive;
    if (!at.change[of_height].row(k).isZero(0.0)) {
      functionals.push_back(by_height(ring, point, side(k) * cosine(k), -sine(k), flank));
      moving.push_back({k, of_height});
    }
    if (!at.change[of_angle].row(k).isZero(0.0)) {
      functionals.push_back(
          ring.tooth(point.tooth, point.flank_radius_mm, -side(k) * sine(k), -cosine(k), point.slice, flank));
      moving.push_back({k, of_angle});
    }
  }
  const auto all = static_cast<Eigen::Index>(functionals.size());
  const Eigen::MatrixXd tooth_tooth = ring.tooth_tooth(functionals);
  Eigen::MatrixXd wall_wall, wall_tooth;
  if (held_lines) {
    wall_wall = Eigen::MatrixXd::Zero(2 * walls, 2 * walls);
    wall_wall.topLeftCorner(walls, walls) =
        assembled_->hold * assembled_->compliance * assembled_->hold.transpose();
    wall_tooth = Eigen::MatrixXd::Zero(2 * walls, all);
    wall_tooth.topRows(walls) =
        assembled_->hold * ring.wall_tooth(assembled_->stations, assembled_->normal, functionals);
    at.wall_force =
        wall_wall.topLeftCorner(walls, walls).llt().solve(wall_tooth.topLeftCorner(walls, teeth) * at.force);
  } else if (linear && in_.surface_slopes.parameter()
                           .empty()) { // nothing turns the normals: their tangents are not needed
    wall_wall = Eigen::MatrixXd::Zero(2 * walls, 2 * walls);
    wall_wall.topLeftCorner(walls, walls) = assembled_->compliance(station, station);
    wall_tooth = Eigen::MatrixXd::Zero(2 * walls, all);
    wall_tooth.topRows(walls) = ring.wall_tooth(at.stations, at.normal, functionals);
  } else {
    const std::vector<WallStation> both = twice(at.stations);
    const Eigen::MatrixX2d directions = stacked(at.normal, tangents(at.normal));
    wall_wall = ring.wall_wall(both, directions);
    wall_tooth = ring.wall_tooth(both, directions, functionals);
  }

  // Displacements under the present forces: of the wall along n and τ, and of the changing functionals since
  // assembly.
  const Eigen::VectorXd u = wall_wall.leftCols(walls) * at.wall_force - wall_tooth.leftCols(teeth) * at.force;
  const Eigen::Index extra = all - teeth;
  Eigen::VectorXd since = wall_tooth.topRightCorner(walls, extra).transpose() * at.wall_force -
                          tooth_tooth.bottomLeftCorner(extra, teeth) * at.force;
  const std::span<const ToothFunctional> changing(functionals.data() + teeth,
                                                  static_cast<std::size_t>(extra));
  if (!linear && extra > 0)
    since -= ring.tooth_displacement(changing, assembled_->stations, assembled_->force_components());

  // What changes with the forces held.
  StateChange change{.wall_displacement = Eigen::MatrixXd::Zero(2 * walls, count_),
                     .wall_gap = Eigen::MatrixXd::Zero(walls, count_),
                     .wall_turn_force = Eigen::MatrixXd::Zero(walls, count_),
                     .tooth_gap = Eigen::MatrixXd(teeth, count_),
                     .torque = Eigen::RowVectorXd(count_)};
  Eigen::MatrixXd dr(teeth, count_);
  for (Eigen::Index k = 0; k < teeth; ++k) {
    const LoadedPoint& point = at.points[static_cast<std::size_t>(k)];
    const auto turn = at.change[of_angle].row(k);
    dr.row(k) =
        side(k) * (cosine(k) * at.change[of_radius].row(k) - sine(k) * point.contact_radius_mm * turn);
    change.tooth_gap.row(k) = cosine(k) * at.change[of_gap].row(k) - sine(k) * point.backlash_mm * turn -
                              load.rotation_rad * dr.row(k);
  }
  change.torque = -at.force.transpose() * dr;
  for (Eigen::Index b = 0; b < extra; ++b) {
    const Moving& m = moving[static_cast<std::size_t>(b)];
    const Eigen::RowVectorXd by = at.change[m.line].row(m.tooth);
    change.tooth_gap.row(m.tooth) -= since(b) * by;
    change.tooth_gap.noalias() += at.force(m.tooth) * tooth_tooth.block(0, teeth + b, teeth, 1) * by;
    change.wall_displacement.noalias() -= at.force(m.tooth) * wall_tooth.col(teeth + b) * by;
  }
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(walls);
  const std::vector<Eigen::Index>& surface_parameter = in_.surface_slopes.parameter();
  if (linear && !held_lines) {
    for (std::size_t c = 0; c < surface_parameter.size(); ++c) { // normals as the assembly turns them
      const auto column = static_cast<Eigen::Index>(c);
      change.wall_gap.col(surface_parameter[c]) = turn_.col(column).cwiseProduct(u.tail(walls));
      change.wall_turn_force.col(surface_parameter[c]) = turn_.col(column).cwiseProduct(at.wall_force);
    }
  }
  if (!linear) {
    const std::span<const ToothFunctional> closed(functionals.data(), static_cast<std::size_t>(teeth));
    for (std::size_t c = 0; c < surface_parameter.size(); ++c)
      change.tooth_gap.col(surface_parameter[c]) +=
          ring.tooth_displacement(closed, closed_, assembled_change(static_cast<Eigen::Index>(c)));
    for (Eigen::Index j = 0; j < walls; ++j) {
      const WallStation& s = at.stations[static_cast<std::size_t>(j)];
      const double nr = at.normal(j, 0), nc = at.normal(j, 1);
      const double w = u(j) * nr - u(walls + j) * nc, v = u(j) * nc + u(walls + j) * nr;
      stiffness(j) = at.wall_force(j) * in_.surface.curvature(s.phi_rad, s.z_mm, w, v);
      for (std::size_t c = 0; c < surface_parameter.size(); ++c) {
        const auto [gap, turn] = in_.surface_slopes.at(static_cast<Eigen::Index>(c), s.phi_rad, s.z_mm, w, v);
        change.wall_gap(j, surface_parameter[c]) = gap;
        change.wall_turn_force(j, surface_parameter[c]) = at.wall_force(j) * turn;
      }
    }
  }

  const ContactTangent tangent({.wall_wall = wall_wall,
                                .wall_tooth = wall_tooth.leftCols(teeth),
                                .tooth_tooth = tooth_tooth.topLeftCorner(teeth, teeth)},
                               at.r, stiffness);
  if (teeth == 0 && control == Control::torque) {
    result.rotation_rad = least_take_up(points);
    return result;
  }
  const StateAnswer answer = tangent.solve(
      change, control == Control::torque ? ContactTangent::Held::torque : ContactTangent::Held::rotation);

  const double lobes = ring.folded() ? 2.0 : 1.0;
  for (Eigen::Index k = 0; k < teeth; ++k)
    result.force_n.row(at.index[static_cast<std::size_t>(k)]) = answer.tooth_force.row(k);
  result.rotation_rad = answer.rotation.transpose();
  result.torque_nm = 1e-3 * lobes * (answer.tooth_force.transpose() * at.r + dr.transpose() * at.force);

  // Tangent stiffness r · M⁻¹ r, with s = M⁻¹ (r, 0) and its own displacements.
  const Eigen::VectorXd s = tangent.rate().head(teeth), s_wall = tangent.rate().tail(walls);
  const Eigen::VectorXd own = wall_tooth.topRightCorner(walls, extra).transpose() * s_wall -
                              tooth_tooth.bottomLeftCorner(extra, teeth) * s;
  const Eigen::VectorXd sideways =
      wall_wall.bottomLeftCorner(walls, walls) * s_wall - wall_tooth.bottomLeftCorner(walls, teeth) * s;
  Eigen::VectorXd slope = 2.0 * dr.transpose() * s;
  for (Eigen::Index b = 0; b < extra; ++b) {
    const Moving& m = moving[static_cast<std::size_t>(b)];
    slope += 2.0 * s(m.tooth) * own(b) * at.change[m.line].row(m.tooth).transpose();
  }
  for (Eigen::Index j = 0; j < walls; ++j)
    if (at.wall_force(j) != 0.0)
      slope -= 2.0 * s_wall(j) * sideways(j) / at.wall_force(j) * answer.wall_tangent.row(j).transpose();
  result.tangent_nm_per_rad = 1e-3 * lobes * slope;

  if (!linear) {
    const Eigen::MatrixX2d across = tangents(at.normal);
    for (Eigen::Index p = 0; p < count_; ++p) {
      Eigen::MatrixX2d change_of_wall(walls, 2);
      for (Eigen::Index j = 0; j < walls; ++j)
        change_of_wall.row(j) =
            answer.wall_normal(j, p) * at.normal.row(j) + answer.wall_tangent(j, p) * across.row(j);
      result.disc_force_n(p) = wall_resultant(at.stations, change_of_wall)(0);
    }
  }
  return result;
}

} // namespace strainwave
