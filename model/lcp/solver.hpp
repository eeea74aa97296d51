#pragma once
// Unilateral contact as a linear complementarity problem with one parameter, the rotation θ of the circular
// spline:
//
//     gap(θ) = q − θ r + M z ≥ 0,    z ≥ 0,    z_i gap_i = 0,    M symmetric positive definite
//
// Unknowns z [N] are forces on drive flanks (r_i = contact radius, mm), on coast flanks (r_i < 0: minus the
// radius; θ opens them) and, with unilateral wall contact, wall forces (r_i = 0); gaps q [mm], M [mm/N]. For
// every θ there is exactly one solution, it is piecewise linear in θ, and the torque r · z never falls
// (strictly rises as soon as an index with r_i ≠ 0 carries force).
//
//     gap, force                    One index: closed once q_1 < θ r_1, then z_1 = (θ r_1 − q_1) / M_11.
//       \      /                    Example: M = 1e-4 mm/N, q = 4e-3 mm, r = 14.5 mm, θ = 1e-3 rad: z = 105
//       N.
//     gap\    /force
//         \  /                      On a closed set A:  M_AA z_A = θ r_A − q_A,  dz_A/dθ = M_AA⁻¹ r_A,
//     _____\/______ θ               d torque/dθ = r_A · M_AA⁻¹ r_A.
//
// How: a primal–dual active set (Hintermüller, Ito, Kunisch 2003, SIAM J. Optim. 13:865) changes all wrong
// indices at once and ends in a few steps. M is no M-matrix, so that method can cycle: a set that returns
// (hash), or too many steps, hands over to single pivots in the manner of Lawson and Hanson (Solving Least
// Squares Problems, 1974, chapter 23), which lower the energy ½ zᵀMz + (q − θ r)ᵀz every time and therefore
// end. Theory: Cottle, Pang, Stone, The Linear Complementarity Problem (1992), chapters 3 and 4.
//
// With r of both signs a gear is free when a range of rotations leaves every index with r ≠ 0 without force
// (first coast touch ≤ θ ≤ first drive touch), else it is wedged: forces of both signs are in balance at no
// torque, at one rotation. There block steps at a torque may drop all that carry; the rotation is then found
// by a bracketed Newton iteration on torque(θ), each value a solution at a rotation.
//
// The result is a fresh solve on the final closed set in ascending index order: its bits do not depend on the
// first set that was supplied. Indices with force and gap both (nearly) zero are decided again from a start
// that does not depend on it.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/lcp/factor.hpp"

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

namespace strainwave {

using ActiveSet = std::vector<std::uint8_t>; ///< 1: closed; empty: no first guess

struct ContactOptions {
  int max_block_steps = 60;    ///< active sets tried before single pivots take over
  double tie_tolerance = 1e-9; ///< a force or gap below this part of its scale counts as zero for ties
};

struct ContactState {
  double rotation = 0.0;     ///< θ, rad
  Eigen::VectorXd force;     ///< z, N; exactly 0 where open
  Eigen::VectorXd gap;       ///< mm; exactly 0 where closed
  ActiveSet active;          ///< 1: closed and carrying
  std::vector<int> biactive; ///< ascending; indices with gap and force both zero (to the tie tolerance)
  double torque = 0.0;       ///< r · z, N·mm
  double stiffness =
      0.0; ///< d torque / dθ towards larger θ (one-sided where biactive is not empty), N·mm/rad
  bool contact = false; ///< some index with r ≠ 0 is closed or biactive; false: no contact at this rotation
  int iterations = 0;   ///< linear systems solved
  bool fallback = false; ///< the block steps returned to a set or were too many: single pivots ended it
};

/// Residuals that prove a state, computed from the problem and the forces alone.
struct ContactCertificate {
  double complementarity = 0.0; ///< max |z_i gap_i| / (force_scale · gap_scale)
  double min_gap = 0.0;         ///< mm (negative: penetration)
  double min_force = 0.0;       ///< N (negative: tension)
  double torque_error = 0.0;    ///< |r · z − torque| / max(|torque|, max r · max z)
  double gap_scale = 0.0;   ///< max |q| + |θ r| of the indices in contact, mm: what min_gap is measured by
  double force_scale = 0.0; ///< max z, N
  int worst = -1;           ///< index of the largest violation, −1 when n = 0
  /// Every residual below the tolerance, relative to its scale.
  bool holds(double tolerance = 1e-10) const;
};

ContactCertificate certify(const ContactProblem& problem, const ContactState& state);

class EventPath;
struct PathRange;

/// Buffers for any number of solves: no allocation once the size is known. One object per thread.
/// Throws std::invalid_argument for sizes that do not match or numbers that are not finite, and
/// NotPositiveDefinite.
class ContactSolver {
public:
  /// Solution at a rotation. `warm` is a first guess of the closed set and nothing else.
  ContactState solve_at(const ContactProblem& problem, double rotation, const ActiveSet& warm = {},
                        const ContactOptions& options = {});
  void solve_at(const ContactProblem& problem, double rotation, const ActiveSet& warm,
                const ContactOptions& options, ContactState& state);

  /// Solution at a torque r · z [N·mm]: the minimum of ½ zᵀMz + qᵀz with r · z = torque, z ≥ 0; θ is the
  /// multiplier. Torque 0 means the take-up: the largest θ without load on an index with r > 0, or the
  /// rotation of the balance when wedged. A torque below 0 needs an index with r < 0, else it is refused
  /// (std::invalid_argument). Status::no_contact when no index has r > 0 (torque ≥ 0).
  Outcome<ContactState> solve_torque(const ContactProblem& problem, double torque, const ActiveSet& warm = {},
                                     const ContactOptions& options = {});

  /// The rotation at which the first index with r > 0 touches, with the supports (r = 0) in equilibrium; may
  /// be negative. Wedged: the rotation at no torque.
  Outcome<double> take_up(const ContactProblem& problem, const ContactOptions& options = {});

  /// Exact path from event to event (path.hpp).
  EventPath trace(const ContactProblem& problem, const PathRange& range, const ContactOptions& options = {});
  void trace(const ContactProblem& problem, const PathRange& range, const ContactOptions& options,
             EventPath& path);

private:
  enum class Mode { rotation, torque, direction }; ///< what the linear systems are solved for
  enum Kind : std::uint8_t { excluded, constrained, unconstrained };

  void prepare(const ContactProblem& problem, const ActiveSet& warm);
  void collect();
  void factorize(const ContactProblem& problem);
  void solve_on_set(std::vector<double>& x);
  void residual(const ContactProblem& problem);
  double rounding(std::size_t index) const; ///< level of rounding of gap_[index]
  bool block_steps(const ContactProblem& problem, const ContactOptions& options);
  void single_pivots(const ContactProblem& problem);
  void pivot_to_optimum(const ContactProblem& problem);
  void drop_tension(const ContactProblem& problem);
  void remove_position(int position);
  void solve_constrained(const ContactProblem& problem, const ContactOptions& options);
  void find_ties(const ContactOptions& options);
  void one_sided_direction(const ContactProblem& problem);
  void emit(const ContactProblem& problem, ContactState& state);
  struct Play { ///< of the supports' equilibrium: first touches on both sides; wedged when coast > drive
    double coast, drive;
    int first_coast = -1, first_drive = -1; ///< −1: there is none
    bool wedged() const { return coast > drive; }
  };
  Play solve_supports(const ContactProblem& problem, const ContactOptions& options);
  void search_rotation(const ContactProblem& problem, const ContactOptions& options);
  friend class PathTracer;

  ActiveFactor factor_;
  Mode mode_ = Mode::rotation;
  double rotation_ = 0.0, torque_ = 0.0; ///< given or found
  double largest_diagonal_ = 0.0;
  double largest_response_ = 0.0; ///< bound of |M z| of the last residual(), mm
  std::vector<double> load_;      ///< q − θ r (direction: −r), by index
  std::vector<double> scale_;     ///< |q| + |θ r|: what load_ is a difference of, by index
  std::vector<double> x_, trial_; ///< unknowns, by position in the factor
  std::vector<double> gap_;       ///< by index
  std::vector<std::uint8_t> closed_, kind_, rejected_;
  std::vector<int> list_, ties_;
  std::vector<std::uint64_t> visited_;
  int iterations_ = 0;
  bool fallback_ = false;
  bool both_signs_ = false; ///< r of both signs
};

} // namespace strainwave
