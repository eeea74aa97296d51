#include "model/contact/load_problem.hpp"

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
                                 std::span<const ToothFunctional> teeth, const Eigen::VectorXd& tooth_force) {
  const HeldWall held = held_wall(ring, assembled, teeth);
  Eigen::VectorXd along = Eigen::VectorXd::Zero(assembled.force_n.size());
  if (held.compliance.size() > 0) {
    // Tooth forces act along minus their functionals, so the wall would move by −G_wt F; the reaction takes it back.
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

Outcome<ExactLoad> correct_to_exact_gap(const RingCompliance& ring, const WaveGeneratorSurface& surface,
                                        const AssembledState& assembled, const LoadProblem& load,
                                        const ContactState& start, Control control, ContactSolver& solver) {
  NewtonEnd end(1e-11); // mm
  constexpr int max_steps = 30;
  const Eigen::Index n = load.point_count;
  const Eigen::Index m = assembled.force_n.size();

  // Tooth displacement by assembly does not change with the load; rows of q for the teeth are kept, wall rows are made anew.
  Eigen::VectorXd tooth_gap = load.problem.q.head(n);
  ExactLoad result;
  result.state = start;
  ContactProblem problem = load.problem;
  Eigen::MatrixX2d normal = assembled.normal;
  Eigen::MatrixXd components; // of the wall by unit tooth loads
  for (int step = 0; step <= max_steps; ++step) {
    const Eigen::VectorXd wall = result.state.force.tail(m);
    result.wall_force = normal.array().colwise() * wall.array();
    const Eigen::MatrixX2d u = ring.wall_displacement(
        assembled.stations, assembled.stations, result.wall_force, load.points, -result.state.force.head(n));
    Eigen::VectorXd gap(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      const WallStation& s = assembled.stations[static_cast<std::size_t>(i)];
      const WallGap g = surface.gap(s.phi_rad, s.z_mm, u(i, 0), u(i, 1));
      gap(i) = g.gap_mm;
      normal(i, 0) = g.radial;
      normal(i, 1) = g.circumferential;
    }
    result.residual_mm = (gap - result.state.gap.tail(m)).cwiseAbs().maxCoeff();
    result.newton_steps = step;
    const double largest_mm = problem.m.diagonal().maxCoeff() * result.state.force.sum();
    if (end.reached(result.residual_mm, gap_rounding_mm(n + m, surface.inner_radius_mm(), largest_mm)))
      break;
    if (step == max_steps || !std::isfinite(result.residual_mm)) {
      return Failure{Status::not_converged,
                     describe_divergence("contact of the wall with the wave generator under load",
                                         result.residual_mm, step)};
    }
    ring.wall_wall(assembled.stations, normal, problem.m.bottomRightCorner(m, m));
    if (step == 0)
      components = ring.wall_components_of_teeth(assembled.stations, load.points);
    const Eigen::MatrixXd wall_tooth = along_normals(normal, components);
    problem.m.bottomLeftCorner(m, n) = -wall_tooth;
    problem.m.topRightCorner(n, m) = -wall_tooth.transpose();
    problem.q.head(n) = tooth_gap;
    problem.q.tail(m) = gap - along_normal(normal, u);
    const ActiveSet warm = result.state.active;
    if (control == Control::torque) {
      auto solved = solver.solve_torque(problem, start.torque, warm);
      if (!solved)
        return solved.failure();
      result.state = std::move(solved).value();
    } else {
      result.state = solver.solve_at(problem, start.rotation, warm);
    }
  }
  result.certificate = certify(problem, result.state);
  result.correction_rotation_rad = result.state.rotation - start.rotation;
  result.correction_force_n =
      n > 0 ? (result.state.force.head(n) - start.force.head(n)).cwiseAbs().maxCoeff() : 0.0;
  return result;
}

} // namespace strainwave
