#pragma once
// The loaded pair linearised about one of its own exact states: what samples near that state are solved with.
//
// Exact contact with the wave generator has gap(u) and forces along the normals n(u) of the displaced wall:
//     u = G (n(u) p + f),     n(u) ≈ n* + t κ t·(u − u*)        (t across n, κ = t · ∂n/∂u · t, on a disc
//     1/distance)
// About a solution (u*, p*, f*) that is, with K = diag(p* κ) over the stations that carry,
//     u − u* = G' (n* Δp + Δf),     G' = (G⁻¹ − t K tᵀ)⁻¹ = G + G t (K⁻¹ − tᵀ G t)⁻¹ tᵀ G
// (the forces turn with the wall; G' is symmetric), gap = gap* + n* · (u − u*). So the tangent is an LCP
// again: M from G', q such that the exact state solves it. What it leaves out is of second order in the
// distance from that state.
//
// Where the turning forces are large enough to push a free cup over (G⁻¹ − t K tᵀ not positive definite: one
// lobe alone, strong cams), only the contact itself holds it, and there is no such compliance: the directions
// of the forces then stay those of the loaded state, which leaves out a term of first order, some thousandths
// of the change of displacement.
//
// Moving or resizing the discs by small δ changes the gaps at u* and turns the normals: q + Σ amplitude ·
// mode with the modes δe, δe² (gaps alone) and δR; see DiscChange.

#include "strainwave/model/contact/load_problem.hpp"

#include <array>
#include <functional>

namespace strainwave {

struct LoadTangent {
  ContactProblem problem; ///< teeth first, then wall stations
  ContactState state;     ///< the exact state, which solves it
  Eigen::MatrixXd
      modes; ///< q's change with the discs, see DiscChange; no columns when the surface has no discs
  bool turning = false; ///< the wall's forces turn with it
};

/// Small changes of both discs alike: eccentricity and neutral radius, mm.
struct DiscChange {
  double eccentricity_mm = 0.0;
  double radius_mm = 0.0;
  std::array<double, 3> amplitudes() const {
    return {eccentricity_mm, eccentricity_mm * eccentricity_mm, radius_mm};
  }
};
/// The wave generator with changed discs; empty for other shapes.
using ChangedSurface = std::function<WaveGeneratorSurface(const DiscChange&)>;

/// `exact`: from correct_to_exact_gap of `load`.
LoadTangent tangent_at(const RingCompliance& ring, const WaveGeneratorSurface& surface,
                       const AssembledState& assembled, const LoadProblem& load, const ExactLoad& exact,
                       const ChangedSurface& changed = {});

/// Where the LCP itself is the model (disc_gap = "linearised"): the same without any turning of the forces.
LoadTangent linear_tangent(const AssembledState& assembled, const LoadProblem& load,
                           const ContactState& state, const ChangedSurface& changed = {});

} // namespace strainwave
