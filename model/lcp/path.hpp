#pragma once
// The exact load path: the solution of the contact problem for every rotation of a range, in closed form from
// event to event.
//
// Between two events the closed set A is constant and everything is linear in θ:
//     z(θ) = z_k + (θ − θ_k) s,   s = M_AA⁻¹ r_A,      gap(θ) = gap_k + (θ − θ_k) g,   g = −r + M s.
// An event is the least θ at which a force falls to zero (the index opens) or a gap closes. One index: it
// changes sides. Several at once, the normal case with two equal lobes: the rates after the event solve the
// same complementarity problem on those indices alone, gap' = −r + M z' with the strictly closed ones free in
// sign; its single solution says who opens, who closes and who stays. z_k is solved anew at every event from
// the factor, so nothing accumulates along the path; the factor itself grows and shrinks by one index at a
// time (k² instead of k³/6).
//
//     torque |            ____/         slope d torque/dθ = s · r_A: rises when a tooth closes, falls when a
//     support
//            |       __ /               (r = 0) lifts off
//            |  ___/
//            |_/________________ θ
//            take-up

#include "strainwave/model/lcp/solver.hpp"

#include <limits>
#include <span>
#include <vector>

namespace strainwave {

struct PathRange {
  double start_rotation = 0.0;                                   ///< rad
  double end_rotation = std::numeric_limits<double>::infinity(); ///< rad
  double end_torque =
      std::numeric_limits<double>::infinity(); ///< r · z, N·mm; the path ends at whichever comes first
};

/// An index that changes sides at an event.
struct ContactChange {
  int index = 0;
  bool closes = false; ///< false: opens
};

struct PathEvent {
  double rotation = 0.0;         ///< rad
  double torque = 0.0;           ///< N·mm
  double stiffness_before = 0.0; ///< d torque / dθ, N·mm/rad
  double stiffness_after = 0.0;
  int first_change = 0, change_count = 0; ///< into EventPath::changes()
};

class EventPath {
public:
  enum class End {
    rotation,   ///< end_rotation reached
    torque,     ///< end_torque reached
    no_contact, ///< nothing more happens on the way to an unbounded end: no index with r > 0 can carry the
                ///< torque asked for
    event_limit ///< more events than any gear has (guard against a degenerate matrix)
  };

  /// State at the start, between events and at the end; θ on an event belongs to what follows.
  /// Throws std::out_of_range outside [start_rotation, end_rotation].
  ContactState at(double rotation) const;
  void at(double rotation, ContactState& state) const;
  /// Throws std::out_of_range outside [start torque, end torque]. At the torque of the start: the largest
  /// such rotation.
  ContactState at_torque(double torque) const;
  double torque_at(double rotation) const;
  double rotation_at(double torque) const;

  double start_rotation() const { return segments_.front().rotation; }
  double end_rotation() const { return end_rotation_; }
  double start_torque() const { return segments_.front().torque; }
  double end_torque() const { return end_torque_; }
  End end() const { return end_; }
  /// Some index with r ≠ 0 is closed or closes within the range.
  bool contact() const { return contact_; }
  const std::vector<PathEvent>& events() const { return events_; }
  /// What changes at an event, ascending index.
  std::span<const ContactChange> changes(const PathEvent& event) const {
    return {changes_.data() + event.first_change, static_cast<std::size_t>(event.change_count)};
  }
  int linear_solves() const { return linear_solves_; }

private:
  friend class PathTracer;
  struct Segment {
    double rotation = 0.0, torque = 0.0, stiffness = 0.0;
  };
  std::size_t segment_at(double rotation) const;
  std::size_t segment_at_torque(double torque) const;
  void evaluate(std::size_t segment, double rotation, ContactState& state) const;
  /// Four columns of n numbers for each segment: force, its rate, gap, its rate.
  const double* column(std::size_t segment, int which) const {
    return data_.data() + (4 * segment + static_cast<std::size_t>(which)) * static_cast<std::size_t>(n_);
  }

  int n_ = 0;
  End end_ = End::rotation;
  bool contact_ = false;
  double end_rotation_ = 0.0, end_torque_ = 0.0;
  int linear_solves_ = 0;
  std::vector<Segment> segments_;
  std::vector<double> data_;
  std::vector<std::uint8_t> active_; ///< n for each segment
  std::vector<double> q_, r_;        ///< of the problem, for torque and ties of a state
  double largest_diagonal_ = 0.0;    ///< of M, mm/N
  std::vector<PathEvent> events_;
  std::vector<ContactChange> changes_;
};

} // namespace strainwave
