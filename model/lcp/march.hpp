#pragma once
// The source text's way along the load path, kept as the baseline that the event path is checked and timed
// against.
//
//     1. step the rotation, solve with the closed set as it is;
//     2. a tooth changes state (a force below zero, a gap below zero): halve the step and try again from
//     before;
//     3. at the least step: let the teeth change, solve until all states are consistent, go on with the full
//     step.
//
// Every point it accepts is a solution. What it does not know is where between two points the events lie:
// each is late by up to the least step h, and so the torque, read off the polygon through the points, is
// wrong by up to (jump of stiffness) × h: first order, at the price of one solve for each step and log2(step
// / h) for each event.

#include "strainwave/model/lcp/solver.hpp"

#include <vector>

namespace strainwave {

struct MarchOptions {
  double step = 1e-4;       ///< full step, rad
  double least_step = 1e-7; ///< rad
};

struct March {
  std::vector<double> rotation; ///< accepted points, rad, the start included
  std::vector<double> torque;   ///< r · z, N·mm
  struct Change {
    double rotation = 0.0; ///< rad: the accepted point at which the change was seen
    int index = 0;
    bool closes = false;
  };
  std::vector<Change> changes;
  ContactState last; ///< state at the end
  int tried = 0;     ///< steps tried: solves on a frozen set
  int halved = 0;    ///< steps given up and halved

  /// On the polygon through the accepted points, N·mm. Throws std::out_of_range outside.
  double torque_at(double rotation) const;
};

/// Throws std::invalid_argument unless 0 < least_step ≤ step and start ≤ end, both finite.
March march(const ContactProblem& problem, double start_rotation, double end_rotation,
            const MarchOptions& options, ContactSolver& solver);

} // namespace strainwave
