#include "strainwave/model/lcp/solver.hpp"

#include "strainwave/model/lcp/limits.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace strainwave {

namespace {

/// A set's hash is the exclusive or of its indices' (splitmix64, Steele, Lea, Flood 2014). A collision only
/// costs time: it hands over to single pivots early.
std::uint64_t hash_of(int index) {
  std::uint64_t h = (static_cast<std::uint64_t>(index) + 1) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}

} // namespace

void ContactSolver::prepare(const ContactProblem& problem, const ActiveSet& warm) {
  const auto n = static_cast<std::size_t>(problem.size());
  if (problem.m.rows() != problem.q.size() || problem.m.cols() != problem.q.size() ||
      problem.r.size() != problem.q.size())
    throw std::invalid_argument("contact problem: the sizes of M, q and r differ");
  if (!warm.empty() && warm.size() != n)
    throw std::invalid_argument("contact problem: the first guess has another size");
  largest_diagonal_ = 0.0;
  double sum = 0.0, least_r = 0.0, most_r = 0.0;
  for (int i = 0; i < problem.size(); ++i) {
    largest_diagonal_ = std::max(largest_diagonal_, problem.m(i, i));
    sum += std::abs(problem.q[i]) + std::abs(problem.r[i]);
    least_r = std::min(least_r, problem.r[i]);
    most_r = std::max(most_r, problem.r[i]);
  }
  if (!std::isfinite(sum))
    throw std::invalid_argument("contact problem: a gap or radius is not finite");
  both_signs_ = least_r < 0.0 && most_r > 0.0;
  factor_.reset(problem.size());
  for (auto* v : {&load_, &scale_, &x_, &trial_, &gap_})
    v->resize(n);
  closed_.assign(n, 0);
  kind_.assign(n, constrained);
  if (list_.capacity() < n)
    list_.reserve(n);
  ties_.clear();
  iterations_ = 0;
  fallback_ = false;
}

void ContactSolver::collect() {
  list_.clear();
  for (std::size_t i = 0; i < closed_.size(); ++i)
    if (closed_[i])
      list_.push_back(static_cast<int>(i));
}

void ContactSolver::factorize(const ContactProblem& problem) {
  collect();
  factor_.factorize(problem, list_);
  ++iterations_;
}

void ContactSolver::solve_on_set(std::vector<double>& x) {
  if (mode_ == Mode::direction)
    return factor_.solve(0.0, 1.0, x.data());
  if (mode_ == Mode::torque)
    rotation_ = (torque_ + factor_.r_q()) / factor_.r_r(); // r · z = torque fixes θ
  factor_.solve(-1.0, rotation_, x.data());
}

void ContactSolver::residual(const ContactProblem& problem) {
  const double q_weight = mode_ == Mode::direction ? 0.0 : 1.0,
               r_weight = mode_ == Mode::direction ? 1.0 : rotation_;
  const auto n = static_cast<std::size_t>(problem.size());
  const double *q = problem.q.data(), *r = problem.r.data();
  for (std::size_t i = 0; i < n; ++i) {
    load_[i] = q_weight * q[i] - r_weight * r[i];
    scale_[i] = std::abs(q_weight * q[i]) + std::abs(r_weight * r[i]);
  }
  double force_sum = 0.0;
  for (int p = 0; p < factor_.size(); ++p)
    force_sum += std::abs(x_[static_cast<std::size_t>(p)]);
  largest_response_ = largest_diagonal_ * force_sum; // |M_ij| ≤ largest diagonal
  add_columns(problem.m, factor_.order(), x_.data(), load_.data(), gap_.data());
}

double ContactSolver::rounding(std::size_t index) const {
  return 16.0 * epsilon * (scale_[index] + largest_response_);
}

/// Primal–dual active set: every index of the wrong sign changes at once. False: a set came back, or too many
/// steps.
bool ContactSolver::block_steps(const ContactProblem& problem, const ContactOptions& options) {
  visited_.clear();
  for (int step = 0; step < options.max_block_steps; ++step) {
    factorize(problem);
    std::uint64_t hash = 0;
    for (const int i : list_)
      hash ^= hash_of(i);
    if (std::find(visited_.begin(), visited_.end(), hash) != visited_.end())
      return false;
    visited_.push_back(hash);
    solve_on_set(x_);
    if (!std::isfinite(rotation_)) // r of both signs: nothing that carries is left
      return false;
    residual(problem);
    bool changed = false;
    std::size_t position = 0;
    for (std::size_t i = 0; i < closed_.size(); ++i) {
      if (closed_[i]) {
        if (!(x_[position++] > 0.0))
          closed_[i] = 0, changed = true;
      } else if (kind_[i] == constrained &&
                 !(gap_[i] >= -rounding(i))) { // also true for NaN, which the factor then names
        closed_[i] = 1;
        changed = true;
      }
    }
    if (!changed)
      return true;
  }
  return false;
}

void ContactSolver::find_ties(const ContactOptions& options) {
  ties_.clear();
  double largest_force = 0.0;
  for (int p = 0; p < factor_.size(); ++p)
    largest_force = std::max(largest_force, x_[static_cast<std::size_t>(p)]);
  const double compliance = largest_diagonal_ > 0.0 ? largest_diagonal_ : 1.0;
  std::size_t position = 0;
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    const double small_gap = options.tie_tolerance * scale_[i];
    const double small_force = std::max(options.tie_tolerance * largest_force, small_gap / compliance);
    const bool tie =
        closed_[i] ? x_[position++] <= small_force : kind_[i] == constrained && gap_[i] <= small_gap;
    if (tie)
      ties_.push_back(static_cast<int>(i));
  }
}

/// From the set in closed_ to the solution: x_ and gap_ fresh on the final set in ascending order, ties_
/// listed.
void ContactSolver::solve_constrained(const ContactProblem& problem, const ContactOptions& options) {
  if (!block_steps(problem, options)) {
    fallback_ = true;
    if (mode_ == Mode::torque && both_signs_) {
      search_rotation(problem, options);
    } else {
      single_pivots(problem);
      drop_tension(problem);
      residual(problem);
    }
  }
  find_ties(options);
  if (ties_.empty())
    return;
  for (const int i : ties_)
    closed_[static_cast<std::size_t>(i)] = 0; // a start that no first guess can have shaped
  single_pivots(problem);
  drop_tension(problem);
  residual(problem);
  find_ties(options);
}

/// What the closed set does for growing θ when ties_ may open or close: the same problem for the rates, gap'
/// = −r + M z', with the closed indices free in sign and the ties constrained. Leaves its set in the factor.
void ContactSolver::one_sided_direction(const ContactProblem& problem) {
  for (std::size_t i = 0; i < kind_.size(); ++i)
    kind_[i] = closed_[i] ? unconstrained : excluded;
  for (const int i : ties_) {
    kind_[static_cast<std::size_t>(i)] = constrained;
    closed_[static_cast<std::size_t>(i)] = 0;
  }
  mode_ = Mode::direction;
  single_pivots(problem);
}

void ContactSolver::emit(const ContactProblem& problem, ContactState& state) {
  const int n = problem.size();
  state.rotation = rotation_;
  state.force.setZero(n);
  state.gap.resize(n);
  state.active.assign(closed_.begin(), closed_.end());
  state.biactive.assign(ties_.begin(), ties_.end());
  state.torque = 0.0;
  state.contact = false;
  std::size_t position = 0;
  for (int i = 0; i < n; ++i) {
    const bool closed = closed_[static_cast<std::size_t>(i)];
    state.gap[i] = closed ? 0.0 : gap_[static_cast<std::size_t>(i)];
    if (!closed)
      continue;
    state.force[i] = x_[position++];
    state.torque += problem.r[i] * state.force[i];
    state.contact = state.contact || problem.r[i] != 0.0;
  }
  for (const int i : ties_)
    state.contact = state.contact || problem.r[i] != 0.0;
  if (!ties_.empty())
    one_sided_direction(problem);
  state.stiffness = factor_.r_r();
  state.iterations = iterations_;
  state.fallback = fallback_;
}

void ContactSolver::solve_at(const ContactProblem& problem, double rotation, const ActiveSet& warm,
                             const ContactOptions& options, ContactState& state) {
  if (!std::isfinite(rotation))
    throw std::invalid_argument("contact problem: the rotation is not finite");
  prepare(problem, warm);
  mode_ = Mode::rotation;
  rotation_ = rotation;
  for (int i = 0; i < problem.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    closed_[at] = warm.empty() ? problem.q[i] - rotation * problem.r[i] < 0.0 : warm[at] != 0;
  }
  solve_constrained(problem, options);
  emit(problem, state);
}

ContactState ContactSolver::solve_at(const ContactProblem& problem, double rotation, const ActiveSet& warm,
                                     const ContactOptions& options) {
  ContactState state;
  solve_at(problem, rotation, warm, options, state);
  return state;
}

} // namespace strainwave
