#pragma once
// Contact of many gears that differ from a nominal one in the gaps and lever arms of their teeth: exact, some
// microseconds each.
//
// The problem is that of load_problem.hpp, gap = q − θ r + M z with teeth and wall stations, and M alike for
// all samples. Once, M is pivoted on the wall stations 0 that carry in the nominal loaded state (Schur
// complement; 1: teeth and all other stations):
//
//     gap_1 = h_1 − θ r_1 + S z_1 + B gap_0        S = M_11 − M_10 M_00⁻¹ M_01,   B = M_10 M_00⁻¹,   C =
//     M_00⁻¹ p_0   = h_0         − Bᵀ z_1 + C gap_0       h_1 = q_1 − B q_0,             h_0 = −C q_0
//
// In a sample the unknowns are then the forces of its closed teeth and of the few stations that have changed
// sides (a station of 0 that lifts off has its gap as unknown): some 30 instead of 150, with the matrix [S B;
// Bᵀ −C] of signed_factor.hpp. All forces and gaps, teeth and walls, are computed and have to have the right
// sign, so the result is the solution of the whole problem. The active set changes block by block as in
// solver.hpp and always starts from the nominal one; the last system is solved on the final set in ascending
// order: no sample shapes the next. Should the blocks not end, ContactSolver solves the whole problem.
//
// Reference: principal pivot transforms, Cottle, Pang, Stone, The Linear Complementarity Problem (1992),
// section 2.3.

#include "strainwave/model/lcp/signed_factor.hpp"
#include "strainwave/model/lcp/solver.hpp"

#include <optional>
#include <span>
#include <vector>

namespace strainwave {

class SampledContact {
public:
  /// `problem`: the first `teeth` indices are teeth (r > 0), all others wall stations (r = 0); its q and r
  /// are the nominal ones. `nominal`: its solution under the nominal load. `modes`: columns that a sample may
  /// add to q with amplitudes of its own (n × modes; empty: none). Throws NotPositiveDefinite,
  /// std::invalid_argument for sizes.
  SampledContact(ContactProblem problem, int teeth, const ContactState& nominal,
                 const Eigen::MatrixXd& modes = {});

  int teeth() const { return teeth_; }
  int size() const { return problem_.size(); }
  std::size_t modes() const { return mode_.size(); }
  const ContactProblem& problem() const { return problem_; }
  const ActiveSet& nominal_set() const { return nominal_; } ///< by index of the problem

private:
  friend class SampleSolver;
  const double* column(int j) const { return a_.data() + static_cast<std::size_t>(j) * stride_; }

  ContactProblem problem_;
  Eigen::MatrixXd modes_; ///< as given
  ActiveSet nominal_;
  int teeth_ = 0;
  int near_ = 0;           ///< rows that are looked at in every step; the others once a solution stands
  std::size_t stride_ = 0; ///< of a_, a multiple of 8
  std::vector<double> a_;  ///< [S B; Bᵀ −C], columns one after the other
  std::vector<int>
      origin_; ///< index of the problem at each place; teeth first, then stations, the least certain first
  std::vector<double> sign_;
  std::vector<double> base_;              ///< h without the teeth's own q
  std::vector<std::vector<double>> mode_; ///< the same for each mode
  std::vector<std::uint8_t> first_set_;   ///< closed teeth of the nominal state; no station has changed sides
  double largest_s_ = 0.0, largest_b_ = 0.0, largest_c_ = 0.0;
};

/// One sample: gaps q [mm] and lever arms r [mm] of all teeth, amplitudes of the modes (none: all 0).
struct ContactSample {
  std::span<const double> gap_mm;
  std::span<const double> radius_mm;
  std::span<const double> amplitude = {};
};

struct SampledState {
  double rotation = 0.0;     ///< θ, rad
  double torque = 0.0;       ///< r · z, N·mm
  double stiffness = 0.0;    ///< d torque / dθ, N·mm/rad
  std::vector<double> force; ///< of the teeth, N; exactly 0 where open
  std::vector<double> gap;   ///< of the teeth, mm; exactly 0 where closed
  int changed_stations = 0;  ///< wall stations on another side than nominally
  int iterations = 0;
  bool fallback = false; ///< ContactSolver has solved the whole problem
};

struct SampleOptions {
  int max_steps = 30; ///< active sets tried before ContactSolver takes over
};

/// One thread's solver. Allocates nothing once it stands, but for the first sample that needs the fall-back.
class SampleSolver {
public:
  /// Keeps a reference.
  explicit SampleSolver(const SampledContact& contact, SampleOptions options = {});

  /// torque > 0, N·mm. Failures: those of ContactSolver (fall-back).
  std::optional<Failure> solve_torque(const ContactSample& sample, double torque, SampledState& state);
  std::optional<Failure> solve_at(const ContactSample& sample, double rotation, SampledState& state);

private:
  std::optional<Failure> solve(const ContactSample& sample, bool at_torque, double value,
                               SampledState& state);
  bool blocks(bool at_torque, double value, SampledState& state);
  bool flip(int from, int to);
  void responses(int from, int to);
  std::optional<Failure> whole_problem(const ContactSample& sample, bool at_torque, double value,
                                       SampledState& state);

  const SampledContact& contact_;
  SampleOptions options_;
  SignedFactor factor_;
  double rotation_ = 0.0;
  double rounding_forward_ = 0.0, rounding_backward_ = 0.0; ///< of gaps (places of +), of forces (−)
  std::vector<double> h_, r_, bq_;                          ///< by place
  std::vector<double> x_, y_; ///< unknowns by position in rows_, results by place
  std::vector<std::uint8_t> active_;
  std::vector<int> rows_;
  int positive_ = 0;
  ContactSolver whole_;
  ContactProblem whole_problem_;
  ContactState whole_state_;
};

} // namespace strainwave
