#include "strainwave/model/loading/phase_model.hpp"

#include "strainwave/model/lcp/march.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace strainwave {

namespace {

double take_up(const LoadedPoint& point) {
  return point.backlash_mm / point.contact_radius_mm;
}

/// Steps of the march: the usual ones, wider for rotations that would take more than some thousand of them.
MarchOptions steps_over(double range) {
  constexpr double most_steps = 4000.0;
  MarchOptions options;
  const double wider = std::max(1.0, range / (most_steps * options.step));
  options.step *= wider;
  options.least_step *= wider;
  return options;
}

/// The source text's way to a torque: march the rotation a little past it, read the rotation off the polygon
/// of accepted points, march there. `direct`, the direct solution, only bounds the march; below 0 the flanks
/// interfere at rest.
ContactState march_to_torque(const ContactProblem& problem, double torque, double direct,
                             ContactSolver& solver) {
  const MarchOptions options = steps_over(std::abs(direct));
  const double start = direct < 0.0 ? direct - 2.0 * options.step : 0.0;
  const March way = march(problem, start, std::max(0.0, direct) + 2.0 * options.step, options, solver);
  std::size_t i = 1;
  while (i + 1 < way.torque.size() && way.torque[i] < torque)
    ++i;
  const double rise = way.torque[i] - way.torque[i - 1];
  const double share = rise > 0.0 ? (torque - way.torque[i - 1]) / rise : 1.0;
  const double rotation = way.rotation[i - 1] + share * (way.rotation[i] - way.rotation[i - 1]);
  return march(problem, start, std::max(start, rotation), options, solver).last;
}

} // namespace

PhaseModel::PhaseModel(const Contact& contact, const RingCompliance& ring,
                       const WaveGeneratorSurface& surface, std::shared_ptr<const AssembledState> assembled,
                       std::vector<LoadedPoint> points, std::vector<LoadedPoint> coast)
    : contact_(contact), ring_(ring), surface_(surface), assembled_(std::move(assembled)),
      drive_(std::move(points)), coast_(std::move(coast)), points_(drive_) {
  points_.insert(points_.end(), coast_.begin(), coast_.end());
  functionals_ = tooth_functionals(ring_, points_);
  std::vector<int> index = first_points();
  if (contact_.fidelity != Fidelity::linear) { // first guess of the wall's set, from the assembly alone
    start_set_.assign(index.size(), 0);
    start_set_.insert(start_set_.end(), assembled_->active.begin(), assembled_->active.end());
  }
  first_ = select(std::move(index));
}

double PhaseModel::least_take_up_rad() const {
  double least = std::numeric_limits<double>::infinity();
  for (const LoadedPoint& point : drive_)
    least = std::min(least, take_up(point));
  return least;
}

double PhaseModel::overlap_rad() const {
  double first_coast = -std::numeric_limits<double>::infinity();
  for (const LoadedPoint& point : coast_)
    first_coast = std::max(first_coast, -take_up(point));
  return first_coast - least_take_up_rad();
}

std::vector<double> PhaseModel::all_forces(const PhaseLoad& load) {
  std::vector<double> forces = load.force_n;
  forces.insert(forces.end(), load.coast_force_n.begin(), load.coast_force_n.end());
  return forces;
}

double PhaseModel::take_up_rad() const {
  return std::max(0.0, least_take_up_rad());
}

PhaseModel::Selection PhaseModel::select(std::vector<int> index) const {
  Selection selection;
  selection.index = std::move(index);
  for (const int i : selection.index)
    selection.points.push_back(points_[static_cast<std::size_t>(i)]);
  selection.load = contact_.fidelity == Fidelity::linear
                       ? linear_problem(ring_, *assembled_, selection.points)
                       : unilateral_problem(ring_, *assembled_, selection.points);
  return selection;
}

/// Of every tooth and slice the point of least take-up, ascending.
std::vector<int> PhaseModel::least_of_tooth_slices(bool coast) const {
  std::map<std::pair<int, int>, int> least; // (tooth, slice) → point
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (points_[i].coast != coast)
      continue;
    const auto [at, fresh] = least.try_emplace({points_[i].tooth, points_[i].slice}, static_cast<int>(i));
    if (!fresh && take_up(points_[i]) < take_up(points_[static_cast<std::size_t>(at->second)])) {
      at->second = static_cast<int>(i);
    }
  }
  std::vector<int> index;
  for (const auto& [key, i] : least)
    index.push_back(i);
  return index;
}

std::vector<int> PhaseModel::first_points() const {
  std::vector<int> index = least_of_tooth_slices(false);
  if (index.size() < drive_.size()) {
    std::stable_sort(index.begin(), index.end(), [&](int a, int b) {
      return take_up(points_[static_cast<std::size_t>(a)]) < take_up(points_[static_cast<std::size_t>(b)]);
    });
    index.resize((index.size() + 1) / 2);
  }
  if (const double overlap = overlap_rad(); overlap > 0.0) {
    const double middle =
        least_take_up_rad() + 0.5 * overlap; // rigid flanks overlap alike on both sides there
    for (const int i : least_of_tooth_slices(true))
      if (take_up(points_[static_cast<std::size_t>(i)]) + middle < 0.0)
        index.push_back(i);
  }
  std::sort(index.begin(), index.end());
  return index;
}

Outcome<PhaseLoad> PhaseModel::at_torque(double torque_nm, ContactSolver& solver) const {
  return solve(Control::torque, 1e3 * torque_nm / first_.load.lobes, solver);
}

Outcome<PhaseLoad> PhaseModel::at_rotation(double rotation_rad, ContactSolver& solver) const {
  return solve(Control::rotation, rotation_rad, solver);
}

Outcome<PhaseLoad> PhaseModel::solve(Control control, double value, ContactSolver& solver) const {
  Selection grown;
  const Selection* selection = &first_;
  ActiveSet warm = start_set_;
  // A selection that is likely to grow grows on the linearised disc gap first.
  bool exact = contact_.fidelity == Fidelity::linear || contact_.disc_gap == DiscGap::linearised ||
               first_.index.size() >= drive_.size();
  for (int round = 1;; ++round) {
    auto solved = solve_selection(*selection, control, value, warm, exact, solver);
    if (!solved)
      return solved.failure();

    PhaseLoad load = solved->load;
    load.rounds = round;
    std::vector<double> force(points_.size(), 0.0);
    std::vector<double> gap_um(points_.size(), 0.0);
    // every point's gap from the forces: closed ones of the selection check the solver, the others must not
    // penetrate
    const Eigen::VectorXd gap = gaps(*selection, solved->state, solved->wall_force);
    std::vector<std::uint8_t> inside(points_.size(), 0);
    for (std::size_t k = 0; k < selection->index.size(); ++k) {
      const auto i = static_cast<std::size_t>(selection->index[k]);
      const auto at = static_cast<Eigen::Index>(k);
      inside[i] = solved->state.active[k] ? 2 : 1;
      force[i] = solved->state.force(at);
      load.recomputed_gap_um = std::max(
          load.recomputed_gap_um, 1e3 * std::abs(gap(static_cast<Eigen::Index>(i)) - solved->state.gap(at)));
    }
    const double rounding_mm =
        1e-13 * std::max(1.0, load.certificate.gap_scale) + 1e-3 * load.recomputed_gap_um;
    std::vector<int> index;
    ActiveSet set; // of the next round: what was closed and what joins
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double g = gap(static_cast<Eigen::Index>(i));
      const bool closed = inside[i] && force[i] > 0.0;
      gap_um[i] = closed ? 0.0 : 1e3 * std::max(0.0, g) / std::cos(points_[i].pressure_angle_rad);
      const bool joins = !inside[i] && g < -rounding_mm;
      if (!inside[i] && !joins)
        continue;
      index.push_back(static_cast<int>(i));
      set.push_back(inside[i] != 1);
    }
    if (index.size() == selection->index.size() && !exact) {
      exact = true;
      warm = solved->state.active;
      continue;
    }
    if (index.size() == selection->index.size()) {
      const auto middle = static_cast<std::ptrdiff_t>(drive_.size());
      load.force_n.assign(force.begin(), force.begin() + middle);
      load.coast_force_n.assign(force.begin() + middle, force.end());
      load.gap_um.assign(gap_um.begin(), gap_um.begin() + middle);
      load.coast_gap_um.assign(gap_um.begin() + middle, gap_um.end());
      return load;
    }
    set.insert(set.end(), solved->state.active.begin() + static_cast<std::ptrdiff_t>(selection->index.size()),
               solved->state.active.end());
    warm = std::move(set);
    grown = select(std::move(index));
    selection = &grown;
  }
}

Outcome<PhaseModel::Solved> PhaseModel::solve_selection(const Selection& selection, Control control,
                                                        double value, const ActiveSet& warm, bool exact,
                                                        ContactSolver& solver) const {
  const ContactProblem& problem = selection.load.problem;
  Solved solved;
  if (control == Control::torque) {
    auto direct = solver.solve_torque(problem, value, warm);
    if (!direct)
      return direct.failure();
    solved.state = std::move(direct).value();
    if (contact_.method == LoadMethod::stepping) {
      solved.state = march_to_torque(problem, value, solved.state.rotation, solver);
    }
  } else if (contact_.method == LoadMethod::stepping && value > 0.0) {
    solved.state = march(problem, 0.0, value, steps_over(value), solver).last;
  } else {
    solved.state = solver.solve_at(problem, value, warm);
  }

  PhaseLoad& load = solved.load;
  if (contact_.fidelity == Fidelity::linear) {
    load.certificate = certify(problem, solved.state);
  } else if (contact_.disc_gap == DiscGap::linearised || !exact) {
    load.certificate = certify(problem, solved.state);
    solved.wall_force = linearised_wall_force(solved.state);
  } else {
    auto corrected =
        correct_to_exact_gap(ring_, surface_, *assembled_, selection.load, solved.state, control, solver);
    if (!corrected)
      return corrected.failure();
    load.certificate = corrected->certificate;
    load.exact_gap_residual_um = 1e3 * corrected->residual_mm;
    load.gap_correction_rotation_rad = corrected->correction_rotation_rad;
    load.gap_correction_force_n = corrected->correction_force_n;
    solved.wall_force = corrected->wall_force;
    solved.state = corrected->state;
  }
  if (solved.wall_force.size() > 0)
    load.disc_force_n = wall_resultant(assembled_->stations, solved.wall_force)(0);
  load.wall_force =
      contact_.fidelity == Fidelity::linear
          ? Eigen::MatrixX2d(assembled_->force_components() +
                             frozen_reaction(ring_, *assembled_, selection.load.points,
                                             solved.state.force.head(selection.load.point_count)))
          : solved.wall_force;
  load.largest_displacement_mm = problem.m.diagonal().maxCoeff() * solved.state.force.sum();
  load.rounding_um =
      1e3 * gap_rounding_mm(problem.size(), surface_.inner_radius_mm(), load.largest_displacement_mm);
  load.rotation_rad = solved.state.rotation;
  load.torque_nm = 1e-3 * selection.load.lobes * solved.state.torque;
  load.tangent_nm_per_rad = 1e-3 * selection.load.lobes * solved.state.stiffness;
  load.contact = solved.state.contact;
  return solved;
}

Eigen::MatrixX2d PhaseModel::linearised_wall_force(const ContactState& state) const {
  const Eigen::VectorXd wall = state.force.tail(assembled_->force_n.size());
  return assembled_->normal.array().colwise() * wall.array();
}

Eigen::VectorXd PhaseModel::gaps(const Selection& selection, const ContactState& state) const {
  return gaps(selection, state,
              contact_.fidelity == Fidelity::linear ? Eigen::MatrixX2d() : linearised_wall_force(state));
}

Eigen::VectorXd PhaseModel::gaps(const Selection& selection, const ContactState& state,
                                 const Eigen::MatrixX2d& wall_force) const {
  const Eigen::VectorXd force = state.force.head(selection.load.point_count);
  // Wall forces beyond those of the assembly; with the wall frozen: the reaction that keeps it where it
  // stands.
  const Eigen::MatrixX2d change = contact_.fidelity == Fidelity::linear
                                      ? frozen_reaction(ring_, *assembled_, selection.load.points, force)
                                      : Eigen::MatrixX2d(wall_force - assembled_->force_components());
  Eigen::VectorXd gap = ring_.tooth_displacement(functionals_, selection.load.points, force) -
                        ring_.tooth_displacement(functionals_, assembled_->stations, change);
  for (Eigen::Index i = 0; i < gap.size(); ++i) {
    const LoadedPoint& point = points_[static_cast<std::size_t>(i)];
    const double turned = (point.coast ? -1.0 : 1.0) * point.contact_radius_mm * state.rotation;
    gap(i) += std::cos(point.pressure_angle_rad) * (point.backlash_mm - turned);
  }
  return gap;
}

} // namespace strainwave
