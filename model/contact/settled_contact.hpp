#pragma once
// The exact state of a contact whose closed sets are known: teeth t with forces F, wall stations with forces
// p along the normals n of the rigid surface at the displaced wall,
//
//     wall    gap(u) = 0 exactly            u = G n(u) p − G_wt F
//     teeth   q + G_tt F − G_tw n(u) p − r θ = 0
//     and  r · F = torque, or θ given.
//
// An LCP with the normals of an earlier state comes near; what is left is of second order in the gap but of
// first order in the direction of the forces. Here the normals follow the displacement in every step, with
// one Cholesky factor of the LCP's closed set for all of them. The steps contract by force × curvature ×
// compliance, some 1e-3, so about five of them end at rounding: a hundredth of the work of as many contact
// problems, and gap and normals agree to 1e-14.

#include "strainwave/model/contact/load_problem.hpp"

namespace strainwave {

/// What is closed, and where to begin.
struct ClosedContact {
  std::vector<WallStation> stations;
  std::vector<ToothFunctional> teeth;
  Eigen::VectorXd q, r; ///< of the teeth; q with the wall's forces at assembly already in it
  Eigen::MatrixX2d normal;
  Eigen::VectorXd wall_force, tooth_force;
  double rotation = 0.0;
};

struct SettledContact {
  bool converged = false;
  Eigen::MatrixX2d normal;       ///< that the forces act along
  Eigen::MatrixX2d displacement; ///< of the closed stations (radial, circumferential), mm
  Eigen::VectorXd wall_force, tooth_force;
  double rotation = 0.0;
  double stiffness = 0.0;   ///< r · M⁻¹ r at these normals, N·mm/rad
  double residual_mm = 0.0; ///< largest gap of what is closed
  int steps = 0;
};

/// torque: per lobe, N·mm; used with Control::torque. Throws NotPositiveDefinite.
SettledContact settle(const RingCompliance& ring, const WaveGeneratorSurface& surface,
                      const ClosedContact& closed, Control control, double torque);

} // namespace strainwave
