#include "strainwave/model/lcp/solver.hpp"

#include "strainwave/model/lcp/limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace strainwave {

namespace {
const char* const nothing_carries =
    "no contact: no index of the contact problem has a radius, so no torque can act";
} // namespace

/// Equilibrium of the indices with r = 0 alone, and the rotations at which the first of the others touch
/// (infinite when there are none); closed_ holds the supports.
ContactSolver::Play ContactSolver::solve_supports(const ContactProblem& problem,
                                                  const ContactOptions& options) {
  mode_ = Mode::rotation;
  rotation_ = 0.0;
  for (int i = 0; i < problem.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    kind_[at] = problem.r[i] != 0.0 ? excluded : constrained;
    closed_[at] = problem.r[i] == 0.0 && problem.q[i] < 0.0;
  }
  solve_constrained(problem, options);
  std::fill(kind_.begin(), kind_.end(), static_cast<std::uint8_t>(constrained));
  Play play{-infinity, infinity};
  for (int i = 0; i < problem.size(); ++i) {
    const double touch = gap_[static_cast<std::size_t>(i)] / problem.r[i];
    if (problem.r[i] > 0.0 && touch < play.drive)
      play.drive = touch, play.first_drive = i;
    if (problem.r[i] < 0.0 && touch > play.coast)
      play.coast = touch, play.first_coast = i;
  }
  return play;
}

/// Torque mode with r of both signs: the root of torque(θ) = torque_, which never falls and is piecewise
/// linear. Every value is a solution at a rotation; its closed set, at the torque, is the next rotation, or
/// the solution when nobody wants to change sides. Newton steps that leave the bracket are replaced by its
/// middle. Leaves set, x_ and gap_.
void ContactSolver::search_rotation(const ContactProblem& problem, const ContactOptions& options) {
  double below = -infinity, above = infinity; // torque(below) < torque_ < torque(above)
  const Play play = solve_supports(problem, options);
  double theta = 0.5 * (play.coast + play.drive);
  double reach = 0.0; // of a step where nothing carries: the largest gap by the least radius
  for (int i = 0; i < problem.size(); ++i)
    if (problem.r[i] != 0.0)
      reach = std::max(reach, std::abs(problem.q[i] - theta * problem.r[i]) / std::abs(problem.r[i]));
  reach = std::max(reach, 1e-9);
  constexpr int limit = 400; // halvings of a bracket end after some 60, widenings before 2000 powers of two
  for (int step = 0; step < limit; ++step) {
    mode_ = Mode::rotation;
    rotation_ = theta;
    if (!block_steps(problem, options)) {
      single_pivots(problem);
      drop_tension(problem);
      residual(problem);
    }
    double torque = 0.0;
    for (int p = 0; p < factor_.size(); ++p)
      torque += problem.r[factor_.order()[static_cast<std::size_t>(p)]] * x_[static_cast<std::size_t>(p)];
    mode_ = Mode::torque;
    double next = std::numeric_limits<double>::quiet_NaN();
    if (factor_.r_r() > 0.0) {
      solve_on_set(x_);
      residual(problem);
      next = rotation_;
      bool consistent = true;
      std::size_t position = 0;
      for (std::size_t i = 0; i < closed_.size(); ++i)
        consistent = consistent &&
                     (closed_[i] ? x_[position++] > 0.0 : kind_[i] != constrained || gap_[i] >= -rounding(i));
      if (consistent)
        return;
    }
    (torque < torque_ ? below : above) = theta;
    if (next > below && next < above) {
      theta = next;
    } else if (std::isfinite(below) && std::isfinite(above)) {
      const double middle = 0.5 * (below + above);
      if (!(middle > below && middle < above))
        return; // neighbours: the kink itself; ties and certificate have the last word
      theta = middle;
    } else {
      theta += torque < torque_ ? reach : -reach;
      reach *= 2.0;
    }
  }
}

Outcome<double> ContactSolver::take_up(const ContactProblem& problem, const ContactOptions& options) {
  prepare(problem, {});
  const Play play = solve_supports(problem, options);
  if (play.first_drive < 0)
    return Failure{Status::no_contact, nothing_carries};
  if (!play.wedged())
    return play.drive;
  auto balance = solve_torque(problem, 0.0, {}, options);
  if (!balance)
    return balance.failure();
  return balance->rotation;
}

Outcome<ContactState> ContactSolver::solve_torque(const ContactProblem& problem, double torque,
                                                  const ActiveSet& warm, const ContactOptions& options) {
  if (!std::isfinite(torque))
    throw std::invalid_argument("contact problem: the torque is not finite");
  prepare(problem, warm);
  if (torque < 0.0 && !(problem.size() > 0 && problem.r.minCoeff() < 0.0))
    throw std::invalid_argument("contact problem: a torque below 0 needs a coast flank (r < 0)");
  // A first guess must carry on the side of the torque, at no torque on both sides.
  bool drives = torque<0.0, coasts = torque> 0.0;
  for (std::size_t i = 0; i < warm.size(); ++i) {
    drives = drives || (warm[i] && problem.r[static_cast<Eigen::Index>(i)] > 0.0);
    coasts = coasts || (warm[i] && problem.r[static_cast<Eigen::Index>(i)] < 0.0);
  }
  if (torque == 0.0 || !(drives && coasts)) {
    // supports in equilibrium, and the index that touches first on the side of the torque takes everything
    const Play play = solve_supports(problem, options);
    if ((torque < 0.0 ? play.first_coast : play.first_drive) < 0)
      return Failure{Status::no_contact, nothing_carries};
    if (torque == 0.0 && !play.wedged())
      return solve_at(problem, play.drive, ActiveSet(closed_), options);
    if (torque >= 0.0)
      closed_[static_cast<std::size_t>(play.first_drive)] = 1;
    if (torque <= 0.0)
      closed_[static_cast<std::size_t>(play.first_coast)] = 1;
  }
  if (drives && coasts) {
    for (std::size_t i = 0; i < warm.size(); ++i)
      closed_[i] = warm[i] != 0;
  }
  mode_ = Mode::torque;
  torque_ = torque;
  solve_constrained(problem, options);
  // Forces of a torque so small that all of them count as ties: the limit, no load.
  if (!std::isfinite(rotation_)) {
    const Play play = solve_supports(problem, options);
    return solve_at(problem, torque < 0.0 ? play.coast : play.drive, ActiveSet(closed_), options);
  }
  ContactState state;
  emit(problem, state);
  if (torque == 0.0)
    state.torque = 0.0; // forces of both signs cancel to rounding
  return state;
}

} // namespace strainwave
