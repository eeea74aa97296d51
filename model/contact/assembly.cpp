#include "model/contact/assembly.hpp"

#include <fmt/format.h>

#include <cmath>

namespace strainwave {

Eigen::MatrixX2d AssembledState::force_components() const {
  return normal.array().colwise() * force_n.array();
}

Eigen::Vector2d wall_resultant(const std::vector<WallStation>& stations, const Eigen::MatrixX2d& force_components) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double c = std::cos(stations[i].phi_rad);
    const double s = std::sin(stations[i].phi_rad);
    if (c < 0.0) continue;
    const auto row = force_components.row(static_cast<Eigen::Index>(i));
    sum += Eigen::Vector2d(c * row(0) - s * row(1), s * row(0) + c * row(1));
  }
  return sum;
}

Outcome<AssembledState> assemble(const RingCompliance& ring, const WaveGeneratorSurface& surface, double phase,
                                 ContactSolver& solver, const AssemblyOptions& options) {
  AssembledState state;
  state.stations = ring.stations(phase);
  const auto n = static_cast<Eigen::Index>(state.stations.size());
  state.normal.resize(n, 2);
  state.gap_mm.resize(n);
  state.force_n = Eigen::VectorXd::Zero(n);
  state.displacement = Eigen::MatrixX2d::Zero(n, 2);
  state.active.assign(static_cast<std::size_t>(n), 0);

  const auto measure = [&] {
    for (Eigen::Index i = 0; i < n; ++i) {
      const WallStation& s = state.stations[static_cast<std::size_t>(i)];
      const WallGap g = surface.gap(s.phi_rad, s.z_mm, state.displacement(i, 0), state.displacement(i, 1));
      state.gap_mm(i) = g.gap_mm;
      state.normal(i, 0) = g.radial;
      state.normal(i, 1) = g.circumferential;
    }
  };

  measure();
  ContactProblem problem;
  problem.r = Eigen::VectorXd::Zero(n);
  for (int step = 1; step <= options.max_newton_steps; ++step) {
    state.newton_steps = step;
    problem.m = ring.wall_wall(state.stations, state.normal);
    problem.q = state.gap_mm - (state.normal.array() * state.displacement.array()).rowwise().sum().matrix();
    const ContactState solved = solver.solve_at(problem, 0.0, step > 1 ? state.active : ActiveSet{});
    state.force_n = solved.force;
    state.active = solved.active;
    state.displacement =
        ring.wall_displacement(state.stations, state.stations, state.force_components(), {}, Eigen::VectorXd());
    measure();
    state.newton_change_mm = (state.gap_mm - solved.gap).cwiseAbs().maxCoeff();
    if (state.newton_change_mm < options.tolerance_mm) break;
  }
  if (!(state.newton_change_mm < options.tolerance_mm)) {
    return Failure{Status::not_converged,
                   fmt::format("assembly on the wave generator did not converge: the gap still changes by {:.3g} mm "
                               "after {} Newton steps",
                               state.newton_change_mm, state.newton_steps)};
  }
  // The normals have just been measured again; the matrix handed on belongs to them.
  state.compliance = ring.wall_wall(state.stations, state.normal);
  const Eigen::MatrixX2d components = state.force_components();
  state.disc_force_n = wall_resultant(state.stations, components)(0);
  bool any = false;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double phi = state.stations[static_cast<std::size_t>(i)].phi_rad;
    if (state.force_n(i) <= 0.0 || std::cos(phi) < 0.0) continue;
    if (!any) state.contact_lo_rad = state.contact_hi_rad = phi;
    any = true;
    state.contact_lo_rad = std::min(state.contact_lo_rad, phi);
    state.contact_hi_rad = std::max(state.contact_hi_rad, phi);
  }
  return state;
}

} // namespace strainwave
