#include "strainwave/model/contact/assembly.hpp"

#include "strainwave/model/contact/settled_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace strainwave {

Eigen::MatrixX2d AssembledState::force_components() const {
  return normal.array().colwise() * force_n.array();
}

Eigen::Vector2d wall_resultant(const std::vector<WallStation>& stations,
                               const Eigen::MatrixX2d& force_components) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double c = std::cos(stations[i].phi_rad);
    const double s = std::sin(stations[i].phi_rad);
    if (c < 0.0)
      continue;
    const auto row = force_components.row(static_cast<Eigen::Index>(i));
    sum += Eigen::Vector2d(c * row(0) - s * row(1), s * row(0) + c * row(1));
  }
  return sum;
}

double gap_rounding_mm(Eigen::Index unknowns, double radius_mm, double largest_displacement_mm) {
  return 4.0 * static_cast<double>(unknowns) * std::numeric_limits<double>::epsilon() *
         (radius_mm + largest_displacement_mm);
}

namespace {

/// Disc force and the outermost loaded stations of the lobe around φ = 0.
void summarise(AssembledState& state) {
  state.disc_force_n = wall_resultant(state.stations, state.force_components())(0);
  bool any = false;
  for (std::size_t i = 0; i < state.stations.size(); ++i) {
    const double phi = state.stations[i].phi_rad;
    if (state.force_n(static_cast<Eigen::Index>(i)) == 0.0 || std::cos(phi) < 0.0)
      continue;
    state.contact_lo_rad = any ? std::min(state.contact_lo_rad, phi) : phi;
    state.contact_hi_rad = any ? std::max(state.contact_hi_rad, phi) : phi;
    any = true;
  }
}

/// Exact gap and normals on the closed set of the last contact problem; false where the steps do not
/// converge, which leaves that problem's forces.
bool settle_closed(const RingCompliance& ring, const WaveGeneratorSurface& surface, AssembledState& state) {
  std::vector<Eigen::Index> index;
  ClosedContact closed;
  for (std::size_t i = 0; i < state.active.size(); ++i) {
    if (!state.active[i])
      continue;
    index.push_back(static_cast<Eigen::Index>(i));
    closed.stations.push_back(state.stations[i]);
  }
  closed.normal = state.normal(index, Eigen::all);
  closed.wall_force = state.force_n(index);
  const SettledContact settled = settle(ring, surface, closed, Control::rotation, 0.0);
  if (!settled.converged)
    return false;
  for (std::size_t k = 0; k < index.size(); ++k) {
    state.force_n(index[k]) = settled.wall_force(static_cast<Eigen::Index>(k));
    state.normal.row(index[k]) = settled.normal.row(static_cast<Eigen::Index>(k));
  }
  return true;
}

} // namespace

std::string describe_divergence(const char* what, double change_mm, int steps) {
  if (!std::isfinite(change_mm)) {
    return fmt::format("{} did not converge: displacements grow beyond all bounds within {} Newton steps",
                       what, steps);
  }
  return fmt::format(
      "{} did not converge: the gap between wall and wave generator still changes by {:.3g} mm after {} "
      "Newton steps",
      what, change_mm, steps);
}

Outcome<AssembledState> assemble(const RingCompliance& ring, const WaveGeneratorSurface& surface,
                                 double phase, ContactSolver& solver, const AssemblyOptions& options) {
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
  bool converged = false;
  for (int step = 1; step <= options.max_newton_steps && !converged; ++step) {
    state.newton_steps = step;
    problem.m = ring.wall_wall(state.stations, state.normal);
    problem.q = state.gap_mm - (state.normal.array() * state.displacement.array()).rowwise().sum().matrix();
    const ContactState solved = solver.solve_at(problem, 0.0, step > 1 ? state.active : ActiveSet{});
    state.force_n = solved.force;
    state.active = solved.active;
    const bool settled = settle_closed(ring, surface, state);
    state.displacement = ring.wall_displacement(state.stations, state.stations, state.force_components(), {},
                                                Eigen::VectorXd());
    measure();
    state.newton_change_mm =
        (state.gap_mm.array() * state.force_n.array().sign() - state.gap_mm.cwiseMin(0.0).array())
            .abs()
            .maxCoeff();
    if (!std::isfinite(state.newton_change_mm) || !state.displacement.allFinite())
      break;
    const double rounding =
        gap_rounding_mm(n, surface.inner_radius_mm(), problem.m.diagonal().maxCoeff() * state.force_n.sum());
    // A pull that moves its station by less than rounding is none.
    const double pull_mm = -(state.force_n.array() * problem.m.diagonal().array()).minCoeff();
    converged =
        settled && pull_mm <= rounding && state.newton_change_mm <= std::max(options.tolerance_mm, rounding);
  }
  if (!converged) {
    return Failure{Status::not_converged, describe_divergence("assembly on the wave generator",
                                                              state.newton_change_mm, state.newton_steps)};
  }
  for (Eigen::Index i = 0; i < n; ++i)
    if (state.force_n(i) <= 0.0) {
      state.force_n(i) = 0.0;
      state.active[static_cast<std::size_t>(i)] = 0;
    }
  // The normals have just been measured again; the matrix handed on belongs to them.
  state.compliance = ring.wall_wall(state.stations, state.normal);
  summarise(state);
  return state;
}

AssembledState hold_at_lines(const RingCompliance& ring, double angle_rad, double displacement_mm,
                             double phase) {
  AssembledState state;
  state.stations = ring.stations(phase);
  const auto n = static_cast<Eigen::Index>(state.stations.size());
  const auto rows = static_cast<Eigen::Index>(ring.rows_mm().size());
  state.normal = Eigen::MatrixX2d::Zero(n, 2);
  state.normal.col(0).setOnes();
  state.compliance = ring.wall_wall(state.stations, state.normal);

  std::vector<double> lines = {-angle_rad, angle_rad};
  if (!ring.folded())
    lines.insert(lines.end(), {angle_rad - std::numbers::pi, std::numbers::pi - angle_rad});
  state.hold = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(lines.size()) * rows, n);
  // Stations stand in groups of `rows` by ascending angle.
  const Eigen::Index groups = n / rows;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    Eigen::Index after = 0;
    while (after < groups - 1 && state.stations[static_cast<std::size_t>(after * rows)].phi_rad < lines[line])
      ++after;
    const Eigen::Index before = std::max<Eigen::Index>(0, after - 1);
    const double lo = state.stations[static_cast<std::size_t>(before * rows)].phi_rad;
    const double hi = state.stations[static_cast<std::size_t>(after * rows)].phi_rad;
    const double share = hi > lo ? (lines[line] - lo) / (hi - lo) : 0.0;
    for (Eigen::Index row = 0; row < rows; ++row) {
      const auto at = static_cast<Eigen::Index>(line) * rows + row;
      state.hold(at, before * rows + row) += 1.0 - share;
      state.hold(at, after * rows + row) += share;
    }
  }
  const Eigen::MatrixXd held = state.hold * state.compliance * state.hold.transpose();
  const Eigen::LLT<Eigen::MatrixXd> factor(held);
  if (factor.info() != Eigen::Success)
    throw NotPositiveDefinite(0, held.diagonal().minCoeff());
  const Eigen::VectorXd reaction = factor.solve(Eigen::VectorXd::Constant(held.rows(), displacement_mm));
  state.force_n = state.hold.transpose() * reaction;
  state.displacement =
      ring.wall_displacement(state.stations, state.stations, state.force_components(), {}, Eigen::VectorXd());
  state.gap_mm = Eigen::VectorXd::Zero(n);
  state.active.assign(static_cast<std::size_t>(n), 0);
  summarise(state);
  return state;
}

} // namespace strainwave
