#pragma once
// The gear on discs with other numbers, between a few that were assembled: poses of all teeth and their
// displacement by assembly as polynomials of u0 and e.
//
// Chebyshev interpolation on a tensor grid over the box that the sources nearly always stay in (inverse
// distances of the nodes: Trefethen, Approximation Theory and Approximation Practice, 2013). The degree grows
// until the interpolant differs from assemblies at points between the nodes by less than the tolerance; the
// largest difference found stays with it. Poses are analytic in u0 and e; the displacement by assembly has
// kinks where a wall station joins or leaves, which limit the accuracy.

#include "strainwave/model/forward/ring_pair.hpp"

#include <span>
#include <vector>

namespace strainwave {

struct DiscBox {
  double u0_lower = 0.0, u0_upper = 0.0; ///< mm; equal: fixed
  double e_lower = 0.0, e_upper = 0.0;
};

struct DiscSurfaceOptions {
  double tolerance_mm = 2e-6; ///< of the difference at the points between; the degree stops growing there
  double most_mm = 5e-5;      ///< above: no interpolant
  int largest_degree = 8;
};

class DiscSurface {
public:
  /// Failures: those of assembly within the box; not_converged when the largest degree leaves more than
  /// most_mm.
  static Outcome<DiscSurface> make(const NominalMesh& mesh, const DiscBox& box,
                                   const DiscSurfaceOptions& options = {});

  /// What a tooth's pose and q change by.
  struct Change {
    double rho_mm = 0.0, phi1_rad = 0.0, normal_rotation_rad = 0.0, shift_mm = 0.0;
  };
  bool contains(double u0_mm, double e_mm) const;
  /// Change from the nominal discs, one for each tooth of the mesh; inside the box. Allocates nothing.
  void at(double u0_mm, double e_mm, std::span<Change> change) const;

  int degree() const { return degree_; }
  double error_mm() const { return error_; } ///< largest difference found, as an arc at the teeth

private:
  static constexpr int most_terms = 81;
  void fit(const NominalMesh& mesh, const std::vector<MeshAtDiscs>& nodes, int degree);
  void evaluate(double u0_mm, double e_mm, std::span<Change> change) const;

  DiscBox box_;
  int degree_ = 0;
  int along_u0_ = 1, along_e_ = 1; ///< terms
  std::size_t teeth_ = 0;
  std::vector<double> coefficient_; ///< 4 × teeth numbers for each term
  std::vector<Change> nominal_;
  double error_ = 0.0;
};

/// The change itself, by assembly.
Outcome<std::vector<DiscSurface::Change>> disc_change(const NominalMesh& mesh, const MeshAtDiscs& nominal,
                                                      double u0_mm, double e_mm);

} // namespace strainwave
