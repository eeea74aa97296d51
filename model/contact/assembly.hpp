#pragma once
// Assembly: the free cup is pushed onto the wave generator. Find wall forces p ≥ 0 along the contact normals
// with
//
//     gap(w, v) ≥ 0,   p · gap = 0,   (w, v) = G N p      (G: free cup, small displacements; N: normals at
//     (w, v))
//
// where the gap is the exact distance of the displaced wall point to the rigid surface. Newton around the
// LCP: with the normals of the last state, gap ≈ gap₀ + N·Δ(w, v), M = NᵀGN; it starts from the undeformed
// wall. Each LCP names a closed set, on which gap and normals are then made exact (settled_contact.hpp); it
// ends when nothing closed pulls and nothing open penetrates by more than `tolerance_mm`. Nothing depends on
// any evaluation before.
//
// The wave generator pushes the wall outwards only; where the cone of the cup lifts the wall off, the force
// is zero.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/contact/ring_compliance.hpp"
#include "strainwave/model/contact/wave_generator_surface.hpp"
#include "strainwave/model/lcp/solver.hpp"

#include <string>
#include <vector>

namespace strainwave {

struct AssembledState {
  std::vector<WallStation> stations;
  Eigen::MatrixX2d normal;       ///< contact normals (radial, circumferential) at the assembled state
  Eigen::VectorXd force_n;       ///< along the normals, ≥ 0
  Eigen::MatrixX2d displacement; ///< (w outwards, v towards larger φ), mm
  Eigen::VectorXd gap_mm;        ///< exact
  ActiveSet active;
  Eigen::MatrixXd compliance; ///< NᵀGN of all stations, mm/N

  /// Only for walls held at lines (four_force): one line of weights on the stations for each held point; else
  /// empty.
  Eigen::MatrixXd hold;

  double disc_force_n = 0.0;   ///< resultant of one lobe along the major axis
  double contact_lo_rad = 0.0; ///< outermost stations of the lobe around φ = 0 that carry force
  double contact_hi_rad = 0.0;
  int newton_steps = 0;
  double newton_change_mm = 0.0; ///< what is left: largest gap where closed, penetration where open

  /// Forces as (radial, circumferential) components, N.
  Eigen::MatrixX2d force_components() const;
};

struct AssemblyOptions {
  double tolerance_mm = 1e-12; ///< where rounding allows
  int max_newton_steps = 40;
};

Outcome<AssembledState> assemble(const RingCompliance& ring, const WaveGeneratorSurface& surface,
                                 double phase, ContactSolver& solver, const AssemblyOptions& options = {});

/// Four radial forces have no surface: the wall is held, both ways, at the lines φ = ±angle (and opposite)
/// along the rows, with the given radial displacement there. Held points between two stations use linear
/// weights.
AssembledState hold_at_lines(const RingCompliance& ring, double angle_rad, double displacement_mm,
                             double phase);

/// What rounding leaves of a gap, mm: the bound 4 n ε (R + G Σ|F|) with n unknowns, wall radius R and G the
/// largest unit response, so that no displacement is larger than G Σ|F|. A Cholesky solve leaves (3n + 1) ε
/// of that in the gaps of the closed points (Higham, Accuracy and Stability of Numerical Algorithms, 2002,
/// theorem 10.4), summing the displacements n ε.
double gap_rounding_mm(Eigen::Index unknowns, double radius_mm, double largest_displacement_mm);

/// "… did not converge: …", with the last change of the gap.
std::string describe_divergence(const char* what, double change_mm, int steps);

/// Resultants (major axis, minor axis) of wall forces over the lobe around φ = 0, N.
Eigen::Vector2d wall_resultant(const std::vector<WallStation>& stations,
                               const Eigen::MatrixX2d& force_components);

} // namespace strainwave
