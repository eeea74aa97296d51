// correct_to_exact_gap of load_problem.hpp: contact problems with the normals of the last state find the
// closed sets, and the state on them is settled exactly (settled_contact.hpp). It is the solution when
// nothing that is closed pulls and nothing that is open penetrates; else the next contact problem starts from
// it.

#include "strainwave/model/contact/settled_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace strainwave {

namespace {

/// The closed points of a state of the load problem.
struct Chosen {
  std::vector<Eigen::Index> teeth, stations;
};

Chosen closed_of(const ContactState& state, Eigen::Index teeth) {
  Chosen chosen;
  for (Eigen::Index i = 0; i < state.force.size(); ++i)
    if (state.active[static_cast<std::size_t>(i)])
      (i < teeth ? chosen.teeth : chosen.stations).push_back(i < teeth ? i : i - teeth);
  return chosen;
}

ClosedContact contact_of(const Chosen& chosen, const AssembledState& assembled, const LoadProblem& load,
                         const ContactState& state, const Eigen::MatrixX2d& normal) {
  const Eigen::Index n = load.point_count;
  ClosedContact closed;
  for (const Eigen::Index i : chosen.stations)
    closed.stations.push_back(assembled.stations[static_cast<std::size_t>(i)]);
  for (const Eigen::Index i : chosen.teeth)
    closed.teeth.push_back(load.points[static_cast<std::size_t>(i)]);
  closed.q = load.problem.q.head(n)(chosen.teeth);
  closed.r = load.problem.r.head(n)(chosen.teeth);
  closed.normal = normal(chosen.stations, Eigen::all);
  closed.wall_force = state.force.tail(state.force.size() - n)(chosen.stations);
  closed.tooth_force = state.force.head(n)(chosen.teeth);
  closed.rotation = state.rotation;
  return closed;
}

/// Residuals of a state from its exact gaps; scales as certify() has them.
ContactCertificate exact_certificate(const ContactProblem& problem, const ContactState& state,
                                     const Eigen::VectorXd& gap) {
  ContactCertificate c;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < gap.size(); ++i) {
    if (state.force(i) > 0.0)
      c.gap_scale = std::max(c.gap_scale, std::abs(problem.q(i)) + std::abs(state.rotation * problem.r(i)));
    c.min_gap = std::min(c.min_gap, gap(i));
    c.min_force = std::min(c.min_force, state.force(i));
    c.force_scale = std::max(c.force_scale, state.force(i));
    const double product = std::abs(state.force(i) * gap(i));
    if (product >= largest) {
      largest = product;
      c.worst = static_cast<int>(i);
    }
  }
  const double scale = c.force_scale * c.gap_scale;
  c.complementarity = scale > 0.0 ? largest / scale : largest;
  const double torque = problem.r.dot(state.force), lever = problem.r.cwiseAbs().maxCoeff() * c.force_scale;
  const double torque_scale = std::max(std::abs(state.torque), lever);
  c.torque_error = torque_scale > 0.0 ? std::abs(torque - state.torque) / torque_scale : 0.0;
  return c;
}

} // namespace

Outcome<ExactLoad> correct_to_exact_gap(const RingCompliance& ring, const WaveGeneratorSurface& surface,
                                        const AssembledState& assembled, const LoadProblem& load,
                                        const ContactState& start, Control control, ContactSolver& solver) {
  constexpr int max_steps = 30;
  const Eigen::Index n = load.point_count;
  const Eigen::Index m = assembled.force_n.size();
  ExactLoad result;
  result.state = start;
  std::optional<ContactProblem> moved; // with the normals of a later state; seldom needed
  Eigen::MatrixX2d normal = assembled.normal;
  double opened = 0.0;
  for (int step = 0; step <= max_steps; ++step) {
    result.newton_steps = step;
    const Chosen chosen = closed_of(result.state, n);
    const SettledContact settled = settle(
        ring, surface, contact_of(chosen, assembled, load, result.state, normal), control, start.torque);
    ContactState state = result.state;
    if (settled.converged) {
      state.rotation = settled.rotation;
      state.force.setZero();
      for (std::size_t k = 0; k < chosen.teeth.size(); ++k)
        state.force(chosen.teeth[k]) = settled.tooth_force(static_cast<Eigen::Index>(k));
      for (std::size_t k = 0; k < chosen.stations.size(); ++k) {
        state.force(n + chosen.stations[k]) = settled.wall_force(static_cast<Eigen::Index>(k));
        normal.row(chosen.stations[k]) = settled.normal.row(static_cast<Eigen::Index>(k));
      }
      state.stiffness = settled.stiffness;
      // As in the LCP: at rest the forces of both flanks cancel, to rounding that differs between processors;
      // the certificate keeps the difference.
      const bool at_rest = control == Control::torque && start.torque == 0.0;
      state.torque = at_rest ? 0.0 : load.problem.r.dot(state.force);
    }
    // All gaps from these forces; normals where the wall now stands.
    const Eigen::VectorXd wall = state.force.tail(m);
    const Eigen::MatrixX2d wall_force = normal.array().colwise() * wall.array();
    const Eigen::MatrixX2d u = ring.wall_displacement(assembled.stations, assembled.stations, wall_force,
                                                      load.points, -state.force.head(n));
    Eigen::VectorXd gap(n + m);
    gap.head(n) = load.problem.q.head(n) +
                  ring.tooth_displacement(load.points, load.points, state.force.head(n)) -
                  ring.tooth_displacement(load.points, assembled.stations, wall_force) -
                  state.rotation * load.problem.r.head(n);
    for (Eigen::Index i = 0; i < m; ++i) {
      const WallStation& s = assembled.stations[static_cast<std::size_t>(i)];
      const WallGap g = surface.gap(s.phi_rad, s.z_mm, u(i, 0), u(i, 1));
      gap(n + i) = g.gap_mm;
      normal(i, 0) = g.radial;
      normal(i, 1) = g.circumferential;
    }
    const double largest_mm = load.problem.m.diagonal().maxCoeff() * state.force.sum();
    const double rounding = std::max(1e-13, gap_rounding_mm(n + m, surface.inner_radius_mm(), largest_mm));
    const double penetration = -gap.minCoeff();
    // A pull that moves its point by less than rounding is none.
    const double pull_mm = -(state.force.array() * load.problem.m.diagonal().array()).minCoeff();
    const bool pushes = pull_mm <= rounding;
    if (settled.converged && pushes && penetration <= rounding) {
      for (Eigen::Index i = 0; i < n + m; ++i)
        if (state.force(i) <= 0.0) {
          state.force(i) = 0.0;
          state.active[static_cast<std::size_t>(i)] = 0;
        }
      result.residual_mm = settled.residual_mm;
      result.wall_force = wall_force;
      result.state = state;
      result.state.gap = gap;
      for (Eigen::Index i = 0; i < n + m; ++i)
        if (result.state.active[static_cast<std::size_t>(i)])
          result.state.gap(i) = 0.0;
      result.certificate = exact_certificate(load.problem, result.state, gap);
      result.correction_rotation_rad = result.state.rotation - start.rotation;
      result.correction_force_n =
          n > 0 ? (result.state.force.head(n) - start.force.head(n)).cwiseAbs().maxCoeff() : 0.0;
      return result;
    }
    opened = std::max(penetration, 0.0);
    if (!gap.allFinite())
      break;
    if (!moved)
      moved = load.problem;
    ContactProblem& problem = *moved;
    problem.m.bottomRightCorner(m, m) = ring.wall_wall(assembled.stations, normal);
    const Eigen::MatrixXd wall_tooth = ring.wall_tooth(assembled.stations, normal, load.points);
    problem.m.bottomLeftCorner(m, n) = -wall_tooth;
    problem.m.topRightCorner(n, m) = -wall_tooth.transpose();
    problem.q.tail(m) = gap.tail(m) - (normal.array() * u.array()).rowwise().sum().matrix();
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
  return Failure{Status::not_converged,
                 describe_divergence("contact of the wall with the wave generator under load", opened,
                                     result.newton_steps)};
}

} // namespace strainwave
