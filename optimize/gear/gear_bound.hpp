#pragma once
// How near a design comes to what no design could beat (force_bound.hpp), for a real gear: any number of
// points a tooth, any fidelity, every phase.
//
// Many points a tooth are lumped so that the bound stays one. Let f_i = Σ F_p over the points of tooth i.
// Where a point carries, its gap is 0; the mean of these equations, weighted with F_p, is
//
//     d_i f_i + Σ_j D̃_ij f_j + c_i ≤ r_i θ,
//     d_i = min FᵀD_ii F over F ≥ 0, ΣF = 1      (the stiffest way to load this tooth alone),
//     D̃_ij = least D_pq over p of i, q of j        r_i = largest lever arm of a point of i.
//
// Every design fulfils it, so the least peak under it is a bound; with one point a tooth nothing is lost.
//
// With fidelity unilateral D belongs to the wall contact that the forces of the bound bring about: wall,
// programme, wall … until the contact does not change. Wall gaps are linearised about the assembled state.
//
// c_i is the least clearance of tooth i over all designs: at the corners and in the middle of the box of
// those variables that move or shape whole flanks, without any removal, but not below what the study demands
// of every design. Clearances are close to linear in these variables (∂c/∂x2 = 75.8 µm on the seed gear), so
// the corners hold the least.
//
// All phases must be carried, so the largest of the phases' bounds counts.

#include "strainwave/model/forward/forward.hpp"
#include "strainwave/optimize/gear/force_bound.hpp"
#include "strainwave/optimize/problem/design.hpp"

#include <map>
#include <optional>
#include <vector>

namespace strainwave {

struct GearBound {
  double peak_force_n = 0.0;
  double rotation_rad = 0.0; ///< that it is allowed
  double torque_nm = 0.0;
  double phase = 0.0;          ///< that decides
  std::vector<int> tooth;      ///< loaded ones, ascending
  std::vector<double> force_n; ///< theirs
  int wall_iterations = 0;     ///< at that phase
  bool wall_at_rest = true;    ///< the wall contact belongs to these forces
};

/// Least clearance of every tooth over a box of designs, by phase of the gear's [load].
struct LeastClearance {
  std::vector<std::map<int, double>> by_phase; ///< tooth → mm, circumferential
  int corners = 0;                             ///< looked at
  int without_result = 0;                      ///< of these
};

/// `at_least_mm`: what the study demands of every design (−infinity: nothing). Fails where no corner has a
/// result.
Outcome<LeastClearance> least_clearance(const ForwardModel& model, const Gear& base,
                                        const DesignSpace& design, double at_least_mm);

/// `gear` is the design whose compliance counts; its [load] names the phases. Nothing in the optional: no set
/// of teeth carries the torque within the rotation.
Outcome<std::optional<GearBound>> gear_force_bound(const ForwardModel& model, const Gear& gear,
                                                   const LeastClearance& clearance, double torque_nm,
                                                   double rotation_rad);

} // namespace strainwave
