#pragma once
// Functionals: weights on the nodes that are load and measurement at once.
//
// A *surface hat* is the traction t = w(x) e / ∫ w dA on a surface, w a product of two hat functions and e
// the local circumferential or radial unit vector of the surface point. Its consistent nodal forces f_a = ∫
// N_a t dA are also the weights of the work-conjugate mean displacement ∫ w e·u dA / ∫ w dA. The integrand is
// smooth only between the kinks of the hats, so every element side is split there and integrated by Gauss
// points (4 × 4 each piece). A *point functional* takes the displacement of one material point through the
// shape functions.
//
// All weights are components in the cylindrical frame of each node's own angle.

#include "strainwave/model/flexspline/mesh.hpp"
#include "strainwave/model/flexspline/unit_responses.hpp"

#include <vector>

namespace strainwave {

/// Sparse weights on the degrees of freedom 3·node + component of one sector.
struct SectorWeights {
  std::vector<int> dof;
  std::vector<double> weight;
  void add(int index, double value) {
    dof.push_back(index);
    weight.push_back(value);
  }
};

/// A functional of a sector: its part on that sector and its part on the next one (towards larger φ).
struct Functional {
  SectorWeights here, next;
};

/// Piecewise linear: 1 at the peak, 0 outside [lower, upper]. lower == peak or peak == upper: half a hat.
struct Hat {
  double lower = 0.0, peak = 0.0, upper = 0.0;
  bool constant = false; ///< 1 everywhere instead
  double operator()(double x) const;
};

/// Hat number `index` of `count` ≥ 2 equidistant ones over [begin, end].
Hat equidistant_hat(double begin, double end, int count, int index);

/// Tractions of unit resultant on one flank of the tooth: a hat in radius times a hat in z. Directions are
/// those of the frame (towards larger φ, outwards) on either flank.
struct DirectionPair {
  Functional circumferential, radial;
};
DirectionPair flank_hat(const SectorMesh& mesh, const Hat& radius, const Hat& z,
                        FlankSide side = FlankSide::drive);

/// On the inner wall: a hat in angle about `offset` pitches from the tooth centre, half width half a pitch,
/// times a hat in z.
DirectionPair wall_hat(const SectorMesh& mesh, double offset, const Hat& z);

/// Moment about the axis of a functional's unit load, N·mm.
double moment_about_axis(const SectorMesh& mesh, const Functional& functional);

/// Displacement components of the material point (radius, angle, z) of sector 0; throws std::logic_error
/// outside the mesh.
struct PointFunctionals {
  SectorWeights radial, circumferential, axial;
};
PointFunctionals point_functionals(const SectorMesh& mesh, const CylinderPoint& point);

/// first·a + second·b, equal degrees of freedom joined, ascending.
SectorWeights combine(const SectorWeights& a, double first, const SectorWeights& b, double second);

} // namespace strainwave
