#include "strainwave/model/contact/load_problem.hpp"

#include <cmath>

namespace strainwave {

namespace {

Eigen::VectorXd along_normal(const Eigen::MatrixX2d& normal, const Eigen::MatrixX2d& vectors) {
  return (normal.array() * vectors.array()).rowwise().sum();
}

/// Teeth's share of the problem that does not depend on the wall: c cos α′ and R cos α′.
void set_point_gaps(std::span<const LoadedPoint> points, ContactProblem& problem) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double cosine = std::cos(points[i].pressure_angle_rad);
    problem.q(static_cast<Eigen::Index>(i)) = points[i].backlash_mm * cosine;
    problem.r(static_cast<Eigen::Index>(i)) =
        (points[i].coast ? -cosine : cosine) * points[i].contact_radius_mm;
  }
}

} // namespace

std::vector<ToothFunctional> tooth_functionals(const RingCompliance& ring,
                                               std::span<const LoadedPoint> points) {
  std::vector<ToothFunctional> result;
  result.reserve(points.size());
  for (const LoadedPoint& point : points) {
    // Along the flank's normal out of the tooth; F > 0 pushes the other way, turned at the use.
    const double cosine = std::cos(point.pressure_angle_rad);
    result.push_back(ring.tooth(point.tooth, point.flank_radius_mm, point.coast ? -cosine : cosine,
                                -std::sin(point.pressure_angle_rad), point.slice,
                                point.coast ? FlankSide::coast : FlankSide::drive));
  }
  return result;
}

namespace {

/// What a frozen contact holds: its own compliance and its displacement from unit tooth loads.
struct HeldWall {
  std::vector<Eigen::Index> closed; ///< stations; empty when lines are held
  Eigen::MatrixXd compliance;
  Eigen::MatrixXd from_teeth;
};

HeldWall held_wall(const RingCompliance& ring, const AssembledState& assembled,
                   std::span<const ToothFunctional> teeth) {
  HeldWall held;
  if (assembled.hold.size() > 0) {
    held.compliance = assembled.hold * assembled.compliance * assembled.hold.transpose();
    held.from_teeth = assembled.hold * ring.wall_tooth(assembled.stations, assembled.normal, teeth);
    return held;
  }
  std::vector<WallStation> stations;
  for (std::size_t i = 0; i < assembled.active.size(); ++i) {
    if (!assembled.active[i])
      continue;
    stations.push_back(assembled.stations[i]);
    held.closed.push_back(static_cast<Eigen::Index>(i));
  }
  held.compliance = assembled.compliance(held.closed, held.closed);
  held.from_teeth = ring.wall_tooth(stations, assembled.normal(held.closed, Eigen::all), teeth);
  return held;
}

} // namespace

Eigen::MatrixXd frozen_compliance(const RingCompliance& ring, const AssembledState& assembled,
                                  std::span<const ToothFunctional> teeth) {
  Eigen::MatrixXd d = ring.tooth_tooth(teeth);
  const HeldWall held = held_wall(ring, assembled, teeth);
  if (held.compliance.size() == 0)
    return d;
  // D = G_tt − YᵀY with Y = L⁻¹ G_wt: symmetric by construction.
  const Eigen::LLT<Eigen::MatrixXd> factor(held.compliance);
  if (factor.info() != Eigen::Success)
    throw NotPositiveDefinite(0, held.compliance.diagonal().minCoeff());
  const Eigen::MatrixXd y = factor.matrixL().solve(held.from_teeth);
  d.selfadjointView<Eigen::Lower>().rankUpdate(y.transpose(), -1.0);
  d.triangularView<Eigen::StrictlyUpper>() = d.transpose();
  return d;
}

Eigen::MatrixX2d frozen_reaction(const RingCompliance& ring, const AssembledState& assembled,
                                 std::span<const ToothFunctional> teeth, const Eigen::VectorXd& all_forces) {
  std::vector<ToothFunctional> loaded; // few of the teeth carry
  Eigen::VectorXd tooth_force(all_forces.size());
  for (Eigen::Index i = 0; i < all_forces.size(); ++i) {
    if (all_forces(i) == 0.0)
      continue;
    tooth_force(static_cast<Eigen::Index>(loaded.size())) = all_forces(i);
    loaded.push_back(teeth[static_cast<std::size_t>(i)]);
  }
  tooth_force.conservativeResize(static_cast<Eigen::Index>(loaded.size()));
  const HeldWall held = held_wall(ring, assembled, loaded);
  Eigen::VectorXd along = Eigen::VectorXd::Zero(assembled.force_n.size());
  if (held.compliance.size() > 0) {
    // Tooth forces act along minus their functionals, so the wall would move by −G_wt F; the reaction takes
    // it back.
    const Eigen::VectorXd reaction = held.compliance.llt().solve(held.from_teeth * tooth_force);
    if (assembled.hold.size() > 0) {
      along = assembled.hold.transpose() * reaction;
    } else {
      along(held.closed) = reaction;
    }
  }
  return assembled.normal.array().colwise() * along.array();
}

LoadProblem linear_problem(const RingCompliance& ring, const AssembledState& assembled,
                           std::span<const LoadedPoint> points) {
  LoadProblem load;
  load.points = tooth_functionals(ring, points);
  load.point_count = static_cast<int>(points.size());
  load.lobes = ring.folded() ? 2.0 : 1.0;
  load.problem.m = frozen_compliance(ring, assembled, load.points);
  load.problem.q.resize(load.point_count);
  load.problem.r.resize(load.point_count);
  set_point_gaps(points, load.problem);
  return load;
}

LoadProblem unilateral_problem(const RingCompliance& ring, const AssembledState& assembled,
                               std::span<const LoadedPoint> points) {
  LoadProblem load;
  load.points = tooth_functionals(ring, points);
  load.point_count = static_cast<int>(points.size());
  load.lobes = ring.folded() ? 2.0 : 1.0;
  const Eigen::Index n = load.point_count;
  const Eigen::Index m = assembled.force_n.size();
  ContactProblem& problem = load.problem;
  problem.m.resize(n + m, n + m);
  problem.m.topLeftCorner(n, n) = ring.tooth_tooth(load.points);
  const Eigen::MatrixXd wall_tooth = ring.wall_tooth(assembled.stations, assembled.normal, load.points);
  problem.m.bottomLeftCorner(m, n) = -wall_tooth;
  problem.m.topRightCorner(n, m) = -wall_tooth.transpose();
  problem.m.bottomRightCorner(m, m) = assembled.compliance;
  problem.q.resize(n + m);
  problem.r.setZero(n + m);
  set_point_gaps(points, problem);
  // d(assembly) = −G_tw p(assembly), towards smaller φ.
  problem.q.head(n) += wall_tooth.transpose() * assembled.force_n;
  problem.q.tail(m) = assembled.gap_mm - along_normal(assembled.normal, assembled.displacement);
  return load;
}

} // namespace strainwave
