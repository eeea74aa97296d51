#include "strainwave/model/lcp/path.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace strainwave {

std::size_t EventPath::segment_at(double rotation) const {
  if (!(rotation >= start_rotation() && rotation <= end_rotation_))
    throw std::out_of_range(fmt::format("rotation {} rad is not on the path [{}, {}]", rotation,
                                        start_rotation(), end_rotation_));
  const auto next = std::upper_bound(segments_.begin(), segments_.end(), rotation,
                                     [](double value, const Segment& s) { return value < s.rotation; });
  return static_cast<std::size_t>(next - segments_.begin()) - 1;
}

std::size_t EventPath::segment_at_torque(double torque) const {
  if (!(torque >= start_torque() && torque <= end_torque_))
    throw std::out_of_range(
        fmt::format("torque {} N mm is not on the path [{}, {}]", torque, start_torque(), end_torque_));
  const auto next = std::upper_bound(segments_.begin(), segments_.end(), torque,
                                     [](double value, const Segment& s) { return value < s.torque; });
  return static_cast<std::size_t>(next - segments_.begin()) - 1;
}

double EventPath::torque_at(double rotation) const {
  const Segment& s = segments_[segment_at(rotation)];
  return s.torque + (rotation - s.rotation) * s.stiffness;
}

double EventPath::rotation_at(double torque) const {
  const Segment& s = segments_[segment_at_torque(torque)];
  return s.stiffness > 0.0 ? s.rotation + (torque - s.torque) / s.stiffness : s.rotation;
}

void EventPath::evaluate(std::size_t segment, double rotation, ContactState& state) const {
  constexpr double tie_tolerance = 1e-9; // as in ContactOptions
  const double step = rotation - segments_[segment].rotation;
  const double *force = column(segment, 0), *force_rate = column(segment, 1);
  const double *gap = column(segment, 2), *gap_rate = column(segment, 3);
  const std::uint8_t* active = active_.data() + segment * static_cast<std::size_t>(n_);
  state.rotation = rotation;
  state.force.resize(n_);
  state.gap.resize(n_);
  state.active.assign(active, active + n_);
  state.biactive.clear();
  state.torque = 0.0;
  state.contact = false;
  state.stiffness = segments_[segment].stiffness;
  state.iterations = 0;
  state.fallback = false;
  double largest_force = 0.0;
  for (int i = 0; i < n_; ++i) {
    state.force[i] = active[i] ? std::max(0.0, force[i] + step * force_rate[i]) : 0.0; // rounding at the ends
    state.gap[i] = active[i] ? 0.0 : gap[i] + step * gap_rate[i];
    state.torque += r_[static_cast<std::size_t>(i)] * state.force[i];
    largest_force = std::max(largest_force, state.force[i]);
  }
  for (int i = 0; i < n_; ++i) { // as in ContactSolver::find_ties
    const auto at = static_cast<std::size_t>(i);
    const double small_gap = tie_tolerance * (std::abs(q_[at]) + std::abs(rotation * r_[at]));
    const bool tie =
        active[i] ? state.force[i] <= std::max(tie_tolerance * largest_force, small_gap / largest_diagonal_)
                  : state.gap[i] <= small_gap;
    if (tie)
      state.biactive.push_back(i);
    if ((tie || active[i]) && r_[static_cast<std::size_t>(i)] != 0.0)
      state.contact = true;
  }
}

void EventPath::at(double rotation, ContactState& state) const {
  evaluate(segment_at(rotation), rotation, state);
}

ContactState EventPath::at(double rotation) const {
  ContactState state;
  at(rotation, state);
  return state;
}

ContactState EventPath::at_torque(double torque) const {
  const std::size_t segment = segment_at_torque(torque);
  const Segment& s = segments_[segment];
  ContactState state;
  evaluate(segment, s.stiffness > 0.0 ? s.rotation + (torque - s.torque) / s.stiffness : s.rotation, state);
  return state;
}

} // namespace strainwave
