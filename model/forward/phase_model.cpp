#include "model/forward/phase_model.hpp"

#include "model/contact/lcp_march.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strainwave {

namespace {

/// The source text's way to a torque: march the rotation a little past it, read the rotation off the polygon of accepted
/// points, march there. `beyond` only bounds the march.
ContactState march_to_torque(const ContactProblem& problem, double torque, double beyond, ContactSolver& solver) {
  const MarchOptions options;
  const March way = march(problem, 0.0, std::max(0.0, beyond) + 2.0 * options.step, options, solver);
  std::size_t i = 1;
  while (i + 1 < way.torque.size() && way.torque[i] < torque) ++i;
  const double rise = way.torque[i] - way.torque[i - 1];
  const double share = rise > 0.0 ? (torque - way.torque[i - 1]) / rise : 1.0;
  const double rotation = way.rotation[i - 1] + share * (way.rotation[i] - way.rotation[i - 1]);
  return march(problem, 0.0, rotation, options, solver).last;
}

} // namespace

PhaseModel::PhaseModel(const Contact& contact, const RingCompliance& ring, const WaveGeneratorSurface& surface,
                       std::shared_ptr<const AssembledState> assembled, std::vector<LoadedTooth> teeth)
    : contact_(contact), ring_(ring), surface_(surface), assembled_(std::move(assembled)), teeth_(std::move(teeth)),
      load_(contact.fidelity == Fidelity::linear ? linear_problem(ring, *assembled_, teeth_)
                                                 : unilateral_problem(ring, *assembled_, teeth_)) {}

double PhaseModel::take_up_rad() const {
  double least = std::numeric_limits<double>::infinity();
  for (const LoadedTooth& tooth : teeth_) least = std::min(least, tooth.backlash_mm / tooth.contact_radius_mm);
  return std::max(0.0, least);
}

Outcome<PhaseLoad> PhaseModel::at_torque(double torque_nm, ContactSolver& solver) const {
  const double torque = 1e3 * torque_nm / load_.lobes;
  const auto start = solver.solve_torque(load_.problem, torque, assembled_guess());
  if (!start) return start.failure();
  if (contact_.method == LoadMethod::stepping) {
    return finish(march_to_torque(load_.problem, torque, start->rotation, solver), Control::torque, solver);
  }
  return finish(*start, Control::torque, solver);
}

Outcome<PhaseLoad> PhaseModel::at_rotation(double rotation_rad, ContactSolver& solver) const {
  if (contact_.method == LoadMethod::stepping && rotation_rad > 0.0) {
    return finish(march(load_.problem, 0.0, rotation_rad, MarchOptions{}, solver).last, Control::rotation, solver);
  }
  return finish(solver.solve_at(load_.problem, rotation_rad, assembled_guess()), Control::rotation, solver);
}

ActiveSet PhaseModel::assembled_guess() const {
  if (contact_.fidelity == Fidelity::linear) return {};
  ActiveSet guess(static_cast<std::size_t>(load_.tooth_count), 0);
  guess.insert(guess.end(), assembled_->active.begin(), assembled_->active.end());
  return guess;
}

double PhaseModel::recomputed_gap_error(const ContactState& state, const Eigen::MatrixX2d* wall_force) const {
  // d from the forces, piece by piece through the ring, not through the solver's matrix.
  const Eigen::Index n = load_.tooth_count;
  const Eigen::VectorXd tooth_force = state.force.head(n);
  const Eigen::VectorXd own = ring_.tooth_tooth(load_.teeth) * tooth_force;
  Eigen::VectorXd from_wall;
  if (contact_.fidelity == Fidelity::linear) {
    // the frozen wall: change of wall forces that keeps the closed stations where assembly put them
    from_wall = load_.problem.m * tooth_force - own;
  } else {
    const Eigen::MatrixX2d change =
        (wall_force ? *wall_force
                    : Eigen::MatrixX2d(assembled_->normal.array().colwise() *
                                       state.force.tail(assembled_->force_n.size()).array())) -
        assembled_->force_components();
    from_wall = -ring_.tooth_displacement(load_.teeth, assembled_->stations, change);
  }
  double worst = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const LoadedTooth& tooth = teeth_[static_cast<std::size_t>(i)];
    const double cosine = std::cos(tooth.pressure_angle_rad);
    const double gap = cosine * (tooth.backlash_mm - tooth.contact_radius_mm * state.rotation) + own(i) + from_wall(i);
    worst = std::max(worst, std::abs(gap - state.gap(i)));
  }
  return worst;
}

Outcome<PhaseLoad> PhaseModel::finish(const ContactState& start, Control control, ContactSolver& solver) const {
  PhaseLoad result;
  const ContactState* state = &start;
  std::optional<ExactLoad> exact;
  if (contact_.fidelity == Fidelity::linear) {
    result.certificate = certify(load_.problem, start);
  } else if (contact_.disc_gap == DiscGap::linearised) {
    result.certificate = certify(load_.problem, start);
    const Eigen::VectorXd wall = start.force.tail(assembled_->force_n.size());
    result.disc_force_n =
        wall_resultant(assembled_->stations, assembled_->normal.array().colwise() * wall.array())(0);
  } else {
    auto corrected = correct_to_exact_gap(ring_, surface_, *assembled_, load_, start, control, solver);
    if (!corrected) return corrected.failure();
    exact = std::move(corrected).value();
    state = &exact->state;
    result.certificate = exact->certificate;
    result.exact_gap_residual_um = 1e3 * exact->residual_mm;
    result.gap_correction_rotation_rad = exact->correction_rotation_rad;
    result.gap_correction_force_n = exact->correction_force_n;
    result.disc_force_n = wall_resultant(assembled_->stations, exact->wall_force)(0);
  }
  result.recomputed_gap_um = 1e3 * recomputed_gap_error(*state, exact ? &exact->wall_force : nullptr);
  result.largest_displacement_mm = load_.problem.m.diagonal().maxCoeff() * state->force.sum();
  result.rounding_um =
      1e3 * gap_rounding_mm(load_.problem.size(), surface_.inner_radius_mm(), result.largest_displacement_mm);
  result.rotation_rad = state->rotation;
  result.torque_nm = 1e-3 * load_.lobes * state->torque;
  result.tangent_nm_per_rad = 1e-3 * load_.lobes * state->stiffness;
  result.contact = state->contact;
  for (std::size_t i = 0; i < teeth_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    result.force_n.push_back(state->force(at));
    result.loaded_backlash_um.push_back(1e3 * std::max(0.0, state->gap(at)) / std::cos(teeth_[i].pressure_angle_rad));
  }
  return result;
}

} // namespace strainwave
