#include "strainwave/model/lcp/sampled_contact.hpp"

#include "strainwave/model/lcp/lanes.hpp"
#include "strainwave/model/lcp/limits.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace strainwave {

namespace {

constexpr std::size_t wide = 8; ///< doubles that are added side by side

std::size_t padded(int n) {
  return (static_cast<std::size_t>(n) + wide - 1) / wide * wide;
}

/// out += Σ_p x_p · column rows[p] over [from, to), both multiples of 8.
void accumulate(const double* a, std::size_t stride, std::span<const int> rows, const double* x,
                std::size_t from, std::size_t to, double* __restrict out) {
  std::size_t p = 0;
  for (; p + 4 <= rows.size(); p += 4) {
    const double* c0 = a + static_cast<std::size_t>(rows[p]) * stride;
    const double* c1 = a + static_cast<std::size_t>(rows[p + 1]) * stride;
    const double* c2 = a + static_cast<std::size_t>(rows[p + 2]) * stride;
    const double* c3 = a + static_cast<std::size_t>(rows[p + 3]) * stride;
    const double x0 = x[p], x1 = x[p + 1], x2 = x[p + 2], x3 = x[p + 3];
    for (std::size_t i = from; i < to; ++i)
      out[i] += (x0 * c0[i] + x1 * c1[i]) + (x2 * c2[i] + x3 * c3[i]);
  }
  for (; p < rows.size(); ++p) {
    const double* c = a + static_cast<std::size_t>(rows[p]) * stride;
    const double xp = x[p];
    for (std::size_t i = from; i < to; ++i)
      out[i] += xp * c[i];
  }
}

} // namespace

SampledContact::SampledContact(ContactProblem problem, int teeth, const ContactState& nominal,
                               const Eigen::MatrixXd& modes)
    : problem_(std::move(problem)), modes_(modes), nominal_(nominal.active), teeth_(teeth) {
  const int n = problem_.size();
  if (teeth < 1 || teeth > n || nominal.force.size() != n || (modes.size() > 0 && modes.rows() != n))
    throw std::invalid_argument("sampled contact: sizes of problem, nominal state and modes differ");

  std::vector<Eigen::Index> held, rest;
  for (int i = 0; i < n; ++i)
    (i >= teeth && nominal_[static_cast<std::size_t>(i)] ? held : rest).push_back(i);
  const auto k = static_cast<Eigen::Index>(held.size());
  const Eigen::MatrixXd m01 = problem_.m(held, rest);
  const Eigen::LLT<Eigen::MatrixXd> factor(problem_.m(held, held));
  if (factor.info() != Eigen::Success)
    throw NotPositiveDefinite(static_cast<int>(held.front()), problem_.m.diagonal().minCoeff());
  const Eigen::MatrixXd bt = factor.solve(m01);
  const Eigen::MatrixXd c = factor.solve(Eigen::MatrixXd::Identity(k, k));
  const Eigen::MatrixXd s = problem_.m(rest, rest) - m01.transpose() * bt;

  // one symmetric matrix in the problem's own order first
  Eigen::MatrixXd whole(n, n);
  whole(rest, rest) = 0.5 * (s + s.transpose());
  whole(rest, held) = bt.transpose();
  whole(held, rest) = bt;
  whole(held, held) = -0.5 * (c + c.transpose());
  largest_s_ = s.diagonal().maxCoeff();
  largest_b_ = bt.size() > 0 ? bt.cwiseAbs().maxCoeff() : 0.0;
  largest_c_ = k > 0 ? c.diagonal().maxCoeff() : 0.0;

  // How little may turn a station: its nominal gap or force against what one newton on any tooth makes of it.
  origin_.resize(static_cast<std::size_t>(n));
  std::iota(origin_.begin(), origin_.end(), 0);
  Eigen::VectorXd certainty = Eigen::VectorXd::Zero(n);
  for (int i = teeth; i < n; ++i) {
    const double slack = nominal_[static_cast<std::size_t>(i)] ? nominal.force(i) : nominal.gap(i);
    certainty(i) = slack / std::max(whole.col(i).head(teeth).cwiseAbs().maxCoeff(), 1e-300);
  }
  std::stable_sort(origin_.begin() + teeth, origin_.end(),
                   [&](int a, int b) { return certainty(a) < certainty(b); });
  const double load = nominal.force.head(teeth).sum();
  int near = teeth;
  while (near < n && certainty(origin_[static_cast<std::size_t>(near)]) < 0.3 * load)
    ++near;
  near_ = near;

  stride_ = padded(n);
  if (stride_ % 64 == 0)
    stride_ += wide; // columns a page apart would share cache sets
  a_.assign(stride_ * static_cast<std::size_t>(n), 0.0);
  sign_.assign(stride_, 1.0);
  base_.assign(stride_, 0.0);
  first_set_.assign(static_cast<std::size_t>(n), 0);
  for (int j = 0; j < n; ++j) {
    const int from = origin_[static_cast<std::size_t>(j)];
    for (int i = 0; i < n; ++i)
      a_[static_cast<std::size_t>(j) * stride_ + static_cast<std::size_t>(i)] =
          whole(origin_[static_cast<std::size_t>(i)], from);
    if (from >= teeth && nominal_[static_cast<std::size_t>(from)])
      sign_[static_cast<std::size_t>(j)] = -1.0;
    if (from < teeth)
      first_set_[static_cast<std::size_t>(j)] = nominal_[static_cast<std::size_t>(from)];
  }

  const auto pivoted = [&](Eigen::VectorXd q) {
    Eigen::VectorXd h(n);
    h(rest) = q(rest) - bt.transpose() * q(held);
    h(held) = -factor.solve(Eigen::VectorXd(q(held)));
    std::vector<double> placed(stride_, 0.0);
    for (int i = 0; i < n; ++i)
      placed[static_cast<std::size_t>(i)] = h(origin_[static_cast<std::size_t>(i)]);
    return placed;
  };
  Eigen::VectorXd walls = problem_.q;
  walls.head(teeth).setZero();
  base_ = pivoted(walls);
  for (Eigen::Index j = 0; j < modes.cols(); ++j)
    mode_.push_back(pivoted(modes.col(j)));
}

SampleSolver::SampleSolver(const SampledContact& contact, SampleOptions options)
    : contact_(contact), options_(options) {
  const auto n = static_cast<std::size_t>(contact.size());
  factor_.reset(contact.size());
  for (auto* v : {&h_, &r_, &bq_, &y_})
    v->assign(contact.stride_, 0.0);
  x_.assign(n, 0.0);
  active_.assign(n, 0);
  rows_.reserve(n);
}

std::optional<Failure> SampleSolver::solve_torque(const ContactSample& sample, double torque,
                                                  SampledState& state) {
  if (!(torque > 0.0) || !std::isfinite(torque))
    throw std::invalid_argument("sampled contact: the torque must be finite and above 0");
  return solve(sample, true, torque, state);
}

std::optional<Failure> SampleSolver::solve_at(const ContactSample& sample, double rotation,
                                              SampledState& state) {
  return solve(sample, false, rotation, state);
}

std::optional<Failure> SampleSolver::solve(const ContactSample& sample, bool at_torque, double value,
                                           SampledState& state) {
  const auto teeth = static_cast<std::size_t>(contact_.teeth_);
  assert(sample.gap_mm.size() == teeth && sample.radius_mm.size() == teeth);
  assert(sample.amplitude.empty() || sample.amplitude.size() == contact_.modes());
  std::copy(contact_.base_.begin(), contact_.base_.end(), h_.begin());
  for (std::size_t j = 0; j < sample.amplitude.size(); ++j) {
    const double amplitude = sample.amplitude[j];
    const double* mode = contact_.mode_[j].data();
    for (std::size_t i = 0; i < contact_.stride_; ++i)
      h_[i] += amplitude * mode[i];
  }
  for (std::size_t i = 0; i < teeth; ++i) {
    h_[i] += sample.gap_mm[i];
    r_[i] = sample.radius_mm[i];
  }
  for (std::size_t i = 0; i < contact_.stride_; ++i)
    bq_[i] = -contact_.sign_[i] * h_[i];
  state.force.resize(teeth);
  state.gap.resize(teeth);
  state.fallback = false;
  if (!blocks(at_torque, value, state))
    return whole_problem(sample, at_torque, value, state);
  return std::nullopt;
}

/// y of the places [from, to): gaps where the sign is +, wall forces where it is −.
void SampleSolver::responses(int from, int to) {
  const auto first = static_cast<std::size_t>(from) / wide * wide, last = padded(to);
  std::fill(y_.begin() + static_cast<std::ptrdiff_t>(first), y_.begin() + static_cast<std::ptrdiff_t>(last),
            0.0);
  accumulate(contact_.a_.data(), contact_.stride_, rows_, x_.data(), first, last, y_.data());
  for (std::size_t i = first; i < last; ++i)
    y_[i] = h_[i] - rotation_ * r_[i] + contact_.sign_[i] * y_[i];
}

/// Every inactive place of [from, to) with the wrong sign becomes active.
bool SampleSolver::flip(int from, int to) {
  bool changed = false;
  for (int i = from; i < to; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double level = (contact_.sign_[at] > 0.0 ? rounding_forward_ : rounding_backward_) +
                         16.0 * epsilon * (std::abs(h_[at]) + std::abs(rotation_ * r_[at]));
    if (!active_[at] && !(y_[at] >= -level)) {
      active_[at] = 1;
      changed = true;
    }
  }
  return changed;
}

bool SampleSolver::blocks(bool at_torque, double value, SampledState& state) {
  const SampledContact& c = contact_;
  const int n = c.size();
  std::copy(c.first_set_.begin(), c.first_set_.end(), active_.begin());
  int in_play = c.near_;
  for (int step = 1; step <= options_.max_steps; ++step) {
    rows_.clear();
    for (int i = 0; i < in_play; ++i)
      if (active_[static_cast<std::size_t>(i)] && c.sign_[static_cast<std::size_t>(i)] > 0.0)
        rows_.push_back(i);
    positive_ = static_cast<int>(rows_.size());
    for (int i = c.teeth_; i < in_play; ++i)
      if (active_[static_cast<std::size_t>(i)] && c.sign_[static_cast<std::size_t>(i)] < 0.0)
        rows_.push_back(i);
    if (!factor_.factorize(c.a_.data(), c.stride_, rows_, positive_, bq_.data(), r_.data()))
      return false;
    if (at_torque) {
      if (!(factor_.r_r() > 0.0))
        return false; // no tooth left
      rotation_ = (value - factor_.r_q()) / factor_.r_r();
    } else {
      rotation_ = value;
    }
    factor_.solve(rotation_, x_.data());

    double forces = 0.0, gaps = 0.0;
    for (std::size_t p = 0; p < rows_.size(); ++p)
      (static_cast<int>(p) < positive_ ? forces : gaps) += std::abs(x_[p]);
    rounding_forward_ = 16.0 * epsilon * (c.largest_s_ * forces + c.largest_b_ * gaps);
    rounding_backward_ = 16.0 * epsilon * (c.largest_b_ * forces + c.largest_c_ * gaps);
    responses(0, in_play);
    bool changed = flip(0, in_play);
    for (std::size_t p = 0; p < rows_.size(); ++p) {
      if (!(x_[p] > 0.0)) {
        active_[static_cast<std::size_t>(rows_[p])] = 0;
        changed = true;
      }
    }
    if (changed)
      continue;
    if (in_play < n) { // the stations that were thought to be certain
      responses(in_play, n);
      if (flip(in_play, n)) {
        in_play = n;
        continue;
      }
    }

    state.rotation = rotation_;
    state.stiffness = factor_.r_r();
    state.iterations = step;
    state.torque = 0.0;
    state.changed_stations = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(c.teeth_); ++i) {
      state.force[i] = 0.0;
      state.gap[i] = active_[i] ? 0.0 : y_[i];
    }
    for (std::size_t p = 0; p < rows_.size(); ++p) {
      const auto i = static_cast<std::size_t>(rows_[p]);
      if (rows_[p] < c.teeth_) {
        state.force[i] = x_[p];
        state.torque += r_[i] * x_[p];
      } else {
        ++state.changed_stations;
      }
    }
    return true;
  }
  return false;
}

std::optional<Failure> SampleSolver::whole_problem(const ContactSample& sample, bool at_torque, double value,
                                                   SampledState& state) {
  const auto teeth = static_cast<Eigen::Index>(contact_.teeth_);
  if (whole_problem_.size() == 0)
    whole_problem_ = contact_.problem_;
  whole_problem_.q = contact_.problem_.q;
  for (std::size_t j = 0; j < sample.amplitude.size(); ++j)
    whole_problem_.q += sample.amplitude[j] * contact_.modes_.col(static_cast<Eigen::Index>(j));
  const Eigen::Map<const Eigen::VectorXd> gap(sample.gap_mm.data(), teeth);
  whole_problem_.q.head(teeth) += gap - contact_.problem_.q.head(teeth);
  whole_problem_.r.head(teeth) = Eigen::Map<const Eigen::VectorXd>(sample.radius_mm.data(), teeth);
  if (at_torque) {
    auto solved = whole_.solve_torque(whole_problem_, value, contact_.nominal_);
    if (!solved)
      return solved.failure();
    whole_state_ = std::move(solved).value();
  } else {
    whole_.solve_at(whole_problem_, value, contact_.nominal_, {}, whole_state_);
  }
  state.rotation = whole_state_.rotation;
  state.torque = whole_state_.torque;
  state.stiffness = whole_state_.stiffness;
  state.iterations = whole_state_.iterations;
  state.fallback = true;
  state.changed_stations = 0;
  for (Eigen::Index i = 0; i < whole_state_.force.size(); ++i) {
    if (i < teeth) {
      state.force[static_cast<std::size_t>(i)] = whole_state_.force(i);
      state.gap[static_cast<std::size_t>(i)] = whole_state_.gap(i);
    } else {
      const auto at = static_cast<std::size_t>(i);
      state.changed_stations += whole_state_.active[at] != contact_.nominal_[at];
    }
  }
  return std::nullopt;
}

} // namespace strainwave
