#include "strainwave/model/lcp/path.hpp"

#include "strainwave/model/lcp/limits.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace strainwave {

namespace {
constexpr double same_event = 1e-11; ///< events nearer than this part of the rotation are one: mirrored pairs
                                     ///< on the discs differ by 2e-12
constexpr int updates_per_factor = 64;
} // namespace

/// One trace: walks from event to event and writes the path.
class PathTracer {
public:
  PathTracer(ContactSolver& solver, const ContactProblem& problem, const PathRange& range,
             const ContactOptions& options, EventPath& path)
      : s_(solver), problem_(problem), range_(range), options_(options), path_(path), n_(problem.size()) {}

  void run() {
    start();
    const int limit = 200 * n_ + 1000;
    for (int turn = 0; turn < limit; ++turn) {
      const double step = next_event();
      if (ends_within(step))
        return;
      const double rotation = s_.rotation_ + step;
      const bool again = !batch_.empty() && step <= window(rotation); // still the same event
      if (again) {
        ++repeats_;
      } else {
        for (const int i : batch_)
          in_batch_[static_cast<std::size_t>(i)] = 0;
        batch_.clear();
        repeats_ = 0;
        at_start_ = false;
        stiffness_before_ = path_.segments_.back().stiffness;
        s_.rotation_ = rotation;
      }
      gather(again ? step : step + window(rotation));
      if (again)
        withdraw_event();
      if (!again && batch_.size() == 1)
        flip(batch_.front());
      else
        decide_batch();
      add_segment();
      if (!at_start_)
        record_event();
    }
    finish(EventPath::End::event_limit, s_.rotation_, path_.segments_.back().torque);
  }

private:
  double window(double rotation) const {
    return same_event * std::max(std::abs(rotation), std::abs(rotation - range_.start_rotation));
  }

  void start() {
    const auto n = static_cast<std::size_t>(n_);
    path_.n_ = n_;
    path_.contact_ = false;
    path_.segments_.clear();
    path_.data_.clear();
    path_.active_.clear();
    path_.events_.clear();
    path_.changes_.clear();
    path_.data_.reserve(4 * n * (n + 4));
    path_.active_.reserve(n * (n + 4));
    path_.segments_.reserve(n + 4);
    path_.q_.assign(problem_.q.data(), problem_.q.data() + n);
    path_.r_.assign(problem_.r.data(), problem_.r.data() + n);
    in_batch_.assign(n, 0);
    was_closed_.assign(n, 0);
    rate_.resize(n);
    for (int i = 0; i < n_; ++i)
      largest_r_ = std::max(largest_r_, std::abs(problem_.r[i]));

    s_.prepare(problem_, {});
    path_.largest_diagonal_ = s_.largest_diagonal_;
    s_.mode_ = ContactSolver::Mode::rotation;
    s_.rotation_ = range_.start_rotation;
    for (int i = 0; i < n_; ++i)
      s_.closed_[static_cast<std::size_t>(i)] = problem_.q[i] - s_.rotation_ * problem_.r[i] < 0.0;
    s_.solve_constrained(problem_, options_);
    if (!s_.ties_.empty()) {
      for (const int i : s_.ties_)
        enter_batch(i);
      at_start_ = true;
      decide_batch();
    }
    for (int i = 0; i < n_; ++i)
      path_.contact_ = path_.contact_ || (s_.closed_[static_cast<std::size_t>(i)] && problem_.r[i] != 0.0);
    add_segment();
  }

  void enter_batch(int i) {
    if (in_batch_[static_cast<std::size_t>(i)])
      return;
    in_batch_[static_cast<std::size_t>(i)] = 1;
    was_closed_[static_cast<std::size_t>(i)] = s_.closed_[static_cast<std::size_t>(i)];
    batch_.push_back(i);
  }

  double* column(int which) {
    return path_.data_.data() + (4 * (path_.segments_.size() - 1) + static_cast<std::size_t>(which)) *
                                    static_cast<std::size_t>(n_);
  }

  /// Forces, gaps and their rates on the present set at the present rotation.
  void add_segment() {
    if (updates_ >= updates_per_factor) {
      s_.factorize(problem_);
      updates_ = 0;
    }
    path_.segments_.push_back({s_.rotation_, 0.0, s_.factor_.r_r()});
    path_.data_.resize(4 * path_.segments_.size() * static_cast<std::size_t>(n_));
    path_.active_.insert(path_.active_.end(), s_.closed_.begin(), s_.closed_.end());
    double *force = column(0), *force_rate = column(1), *gap = column(2), *gap_rate = column(3);
    s_.factor_.solve(s_.rotation_, s_.x_.data(), rate_.data());
    s_.iterations_ += 2;
    for (int i = 0; i < n_; ++i) {
      force[i] = force_rate[i] = 0.0;
      gap[i] = problem_.q[i] - s_.rotation_ * problem_.r[i];
      gap_rate[i] = -problem_.r[i];
    }
    const auto order = s_.factor_.order();
    double sum = 0.0;
    force_rate_scale_ = 0.0;
    for (std::size_t p = 0; p < order.size(); ++p) {
      force[order[p]] = s_.x_[p];
      force_rate[order[p]] = rate_[p];
      sum += std::abs(rate_[p]);
      force_rate_scale_ = std::max(force_rate_scale_, std::abs(rate_[p]));
    }
    gap_rate_scale_ = largest_r_ + s_.largest_diagonal_ * sum;
    add_columns(problem_.m, order, s_.x_.data(), rate_.data(), gap, gap_rate);
    double torque = 0.0;
    for (int i = 0; i < n_; ++i)
      torque += problem_.r[i] * force[i];
    // Continuous, and rounding must not let it fall.
    if (path_.segments_.size() > 1) {
      const EventPath::Segment& before = path_.segments_[path_.segments_.size() - 2];
      torque = before.stiffness > 0.0 ? std::max(before.torque, torque) : before.torque;
    }
    path_.segments_.back().torque = torque;
  }

  /// What is left of index i until its event, as a step in θ; infinite when it moves away or rests.
  double distance(int i) {
    const bool closed = s_.closed_[static_cast<std::size_t>(i)];
    const double value = closed ? column(0)[i] : column(2)[i], rate = closed ? column(1)[i] : column(3)[i];
    const double noise = closed ? 1e-13 * force_rate_scale_ : 16.0 * epsilon * gap_rate_scale_;
    if (!(rate < -noise))
      return infinity;
    if (in_batch_[static_cast<std::size_t>(i)]) { // just decided: only a rate well above rounding counts
      const double scale = closed ? force_rate_scale_ : gap_rate_scale_;
      if (repeats_ > 2 * n_ + 10 || rate > -1e-9 * scale)
        return infinity;
    }
    return std::max(0.0, value) / -rate;
  }

  double next_event() {
    double least = infinity;
    for (int i = 0; i < n_; ++i)
      least = std::min(least, distance(i));
    return least;
  }

  void gather(double step) {
    for (int i = 0; i < n_; ++i)
      if (distance(i) <= step)
        arriving_.push_back(i);
    for (const int i : arriving_)
      enter_batch(i);
    arriving_.clear();
    std::sort(batch_.begin(), batch_.end());
  }

  bool ends_within(double step) {
    const EventPath::Segment& last = path_.segments_.back();
    const double to_rotation = range_.end_rotation - last.rotation;
    const double to_torque = last.torque >= range_.end_torque ? 0.0
                             : last.stiffness > 0.0 ? (range_.end_torque - last.torque) / last.stiffness
                                                    : infinity;
    if (step < std::min(to_rotation, to_torque))
      return false;
    if (to_torque < infinity && to_torque <= to_rotation)
      finish(EventPath::End::torque, last.rotation + to_torque, std::max(last.torque, range_.end_torque));
    else if (to_rotation < infinity)
      finish(EventPath::End::rotation, range_.end_rotation, last.torque + last.stiffness * to_rotation);
    else if (last.stiffness > 0.0)
      finish(EventPath::End::rotation, infinity, infinity);
    else
      finish(EventPath::End::no_contact, infinity, last.torque);
    return true;
  }

  void finish(EventPath::End end, double rotation, double torque) {
    path_.end_ = end;
    path_.end_rotation_ = rotation;
    path_.end_torque_ = torque;
    path_.linear_solves_ = s_.iterations_;
  }

  int position_of(int index) const {
    const auto order = s_.factor_.order();
    return static_cast<int>(std::find(order.begin(), order.end(), index) - order.begin());
  }

  void flip(int index) {
    std::uint8_t& closed = s_.closed_[static_cast<std::size_t>(index)];
    if (closed)
      s_.factor_.remove(position_of(index));
    else
      s_.factor_.append(problem_, index);
    closed = !closed;
    ++updates_;
  }

  /// Several at once: the problem for the rates decides on which side each of them leaves the event.
  void decide_batch() {
    for (const int i : batch_) {
      if (!s_.closed_[static_cast<std::size_t>(i)])
        continue;
      s_.factor_.remove(position_of(i));
      s_.closed_[static_cast<std::size_t>(i)] = 0;
      ++updates_;
    }
    for (std::size_t i = 0; i < s_.kind_.size(); ++i)
      s_.kind_[i] = s_.closed_[i] ? ContactSolver::unconstrained : ContactSolver::excluded;
    for (const int i : batch_)
      s_.kind_[static_cast<std::size_t>(i)] = ContactSolver::constrained;
    s_.mode_ = ContactSolver::Mode::direction;
    s_.solve_on_set(s_.x_);
    s_.pivot_to_optimum(problem_);
    s_.mode_ = ContactSolver::Mode::rotation;
    updates_ += static_cast<int>(batch_.size());
  }

  void record_event() {
    const EventPath::Segment& now = path_.segments_.back();
    const auto first = static_cast<int>(path_.changes_.size());
    for (const int i : batch_) {
      const bool closed = s_.closed_[static_cast<std::size_t>(i)];
      if (closed == static_cast<bool>(was_closed_[static_cast<std::size_t>(i)]))
        continue;
      path_.changes_.push_back({i, closed});
      if (closed && problem_.r[i] != 0.0)
        path_.contact_ = true;
    }
    const int count = static_cast<int>(path_.changes_.size()) - first;
    if (count == 0)
      return;
    path_.events_.push_back({now.rotation, now.torque, stiffness_before_, now.stiffness, first, count});
  }

  /// The last event goes on: take its segment and its record back, keep who took part.
  void withdraw_event() {
    if (!path_.events_.empty() && path_.events_.back().rotation == path_.segments_.back().rotation) {
      path_.changes_.resize(static_cast<std::size_t>(path_.events_.back().first_change));
      path_.events_.pop_back();
    }
    path_.segments_.pop_back();
    path_.active_.resize(path_.active_.size() - static_cast<std::size_t>(n_));
  }

  ContactSolver& s_;
  const ContactProblem& problem_;
  const PathRange range_;
  const ContactOptions& options_;
  EventPath& path_;
  const int n_;
  std::vector<int> batch_, arriving_;               ///< indices that took part in the present event
  std::vector<std::uint8_t> in_batch_, was_closed_; ///< by index; was_closed_: before the event
  std::vector<double> rate_;
  double largest_r_ = 0.0, force_rate_scale_ = 0.0, gap_rate_scale_ = 0.0, stiffness_before_ = 0.0;
  int repeats_ = 0, updates_ = 0;
  bool at_start_ = false;
};

void ContactSolver::trace(const ContactProblem& problem, const PathRange& range,
                          const ContactOptions& options, EventPath& path) {
  if (!std::isfinite(range.start_rotation) || !(range.end_rotation >= range.start_rotation) ||
      std::isnan(range.end_torque))
    throw std::invalid_argument(
        "contact path: the range must start at a finite rotation and end at or after it");
  PathTracer(*this, problem, range, options, path).run();
}

EventPath ContactSolver::trace(const ContactProblem& problem, const PathRange& range,
                               const ContactOptions& options) {
  EventPath path;
  trace(problem, range, options, path);
  return path;
}

} // namespace strainwave
