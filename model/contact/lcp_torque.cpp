#include "model/contact/lcp.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace strainwave {

namespace {
const char* const nothing_carries =
    "no contact: no index of the contact problem has a radius, so no torque can act";
}

/// Equilibrium of the indices with r = 0 alone. Returns the rotation at which the first of the others touches
/// (infinite when there is none); closed_ holds the supports.
double ContactSolver::solve_supports(const ContactProblem& problem, const ContactOptions& options,
                                     int& first_index) {
  mode_ = Mode::rotation;
  rotation_ = 0.0;
  for (int i = 0; i < problem.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    kind_[at] = problem.r[i] > 0.0 ? excluded : constrained;
    closed_[at] = problem.r[i] == 0.0 && problem.q[i] < 0.0;
  }
  solve_constrained(problem, options);
  std::fill(kind_.begin(), kind_.end(), static_cast<std::uint8_t>(constrained));
  double least = std::numeric_limits<double>::infinity();
  first_index = -1;
  for (int i = 0; i < problem.size(); ++i) {
    if (!(problem.r[i] > 0.0))
      continue;
    const double touch = gap_[static_cast<std::size_t>(i)] / problem.r[i];
    if (touch < least)
      least = touch, first_index = i;
  }
  return least;
}

Outcome<double> ContactSolver::take_up(const ContactProblem& problem, const ContactOptions& options) {
  prepare(problem, {});
  int first = -1;
  const double rotation = solve_supports(problem, options, first);
  if (first < 0)
    return Failure{Status::no_contact, nothing_carries};
  return rotation;
}

Outcome<ContactState> ContactSolver::solve_torque(const ContactProblem& problem, double torque,
                                                  const ActiveSet& warm, const ContactOptions& options) {
  if (!std::isfinite(torque) || torque < 0.0)
    throw std::invalid_argument("contact problem: the torque must be finite and not negative");
  if (torque == 0.0) {
    const Outcome<double> rotation = take_up(problem, options);
    if (!rotation)
      return rotation.failure();
    return solve_at(problem, *rotation, ActiveSet(closed_), options);
  }
  prepare(problem, warm);
  bool carries = false;
  for (std::size_t i = 0; i < warm.size(); ++i) {
    closed_[i] = warm[i] != 0;
    carries = carries || (closed_[i] && problem.r[static_cast<Eigen::Index>(i)] > 0.0);
  }
  if (!carries) { // supports in equilibrium, and the tooth that touches first takes everything
    int first = -1;
    solve_supports(problem, options, first);
    if (first < 0)
      return Failure{Status::no_contact, nothing_carries};
    closed_[static_cast<std::size_t>(first)] = 1;
  }
  mode_ = Mode::torque;
  torque_ = torque;
  solve_constrained(problem, options);
  // Forces of a torque so small that all of them count as ties: the limit, no torque.
  if (!std::isfinite(rotation_))
    return solve_torque(problem, 0.0, {}, options);
  ContactState state;
  emit(problem, state);
  return state;
}

} // namespace strainwave
