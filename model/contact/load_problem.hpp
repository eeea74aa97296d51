#pragma once
// The loaded pair as one LCP about the assembled state (physics: F and tooth displacements positive towards
// smaller φ, wall forces p along the contact normals):
//
//   linear       gap_i = c_i + (D F)_i − R_i θ,   D = G_tt − G_tw G_ww⁻¹ G_wt over the wall stations that
//   assembly closed:
//                the discs stay in contact there, even in tension.
//   unilateral   unknowns F and p together:  d = G_tt F − G_tw p,   gap_i = c_i + d_i − d_i(assembly) − R_i
//   θ,
//                wall: gap_j = gap_j(assembly) + n_j · (u_j − u_j(assembly)),   u = G_ww p − G_wt F.
//
// With a force along the flank normal (local pressure angle α′ of the contact) F is the normal force: it
// loads cos α′ circumferentially and sin α′ inwards, the gap is c cos α′ and the lever arm R cos α′, so that
// D stays symmetric. Torque = lobes · Σ F_i arm_i.
//
// Coast flanks are candidates of the same LCP. With n the flank's normal out of the tooth,
//     drive  n = ( cos α′ φ̂ + sin α′ r̂)    F pushes towards smaller φ and inwards     arm = +R cos α′
//     coast  n = (−cos α′ φ̂ + sin α′ r̂)    F pushes towards larger φ and inwards      arm = −R cos α′
// the force on the tooth is −F n and the gap c cos α′ − n·u − arm θ on either flank; all above holds with d =
// −n·u and the signed arm. A wedged gear has forces on both at no torque.

#include "strainwave/model/contact/assembly.hpp"

#include <vector>

namespace strainwave {

/// One point that may carry load: the only one of its tooth (the source text's model) or one of many over
/// flank and face.
struct LoadedPoint {
  int tooth = 0; ///< material index; its sector
  double phi_rad = 0.0;
  double backlash_mm = 0.0;       ///< c, circumferential; negative: interference
  double contact_radius_mm = 0.0; ///< R: lever arm, distance of the deformed point from the gear's axis
  double flank_radius_mm =
      0.0; ///< of the point on the undeformed flexspline: where the unit responses are taken
  double pressure_angle_rad = 0.0; ///< α′; 0: circumferential force
  int slice = -1;                  ///< of the face; −1: shared evenly by all
  double z_mm = 0.0;
  int level = 0; ///< which of its tooth's heights: of the hats, or −1 for the circular spline's tip edge; one
                 ///< point: 0
  bool coast = false; ///< on the coast flank: pushed towards larger φ, closed by a rotation towards smaller θ
  bool edge = false; ///< a tip edge of either member touches, not flank on flank
};

struct LoadProblem {
  ContactProblem problem;              ///< points of the teeth first, then (unilateral) wall stations
  std::vector<ToothFunctional> points; ///< along the flanks' normals out of the tooth
  int point_count = 0;
  double lobes = 2.0; ///< torque = lobes · r · z
};

/// Compliance of the teeth on the discs with the assembled contact frozen (held both ways), mm/N.
Eigen::MatrixXd frozen_compliance(const RingCompliance& ring, const AssembledState& assembled,
                                  std::span<const ToothFunctional> teeth);

/// Wall forces (radial, circumferential; one line a station; N) with which a frozen contact answers tooth
/// forces: the change that keeps the held wall where assembly put it.
Eigen::MatrixX2d frozen_reaction(const RingCompliance& ring, const AssembledState& assembled,
                                 std::span<const ToothFunctional> teeth, const Eigen::VectorXd& tooth_force);

std::vector<ToothFunctional> tooth_functionals(const RingCompliance& ring,
                                               std::span<const LoadedPoint> points);

LoadProblem linear_problem(const RingCompliance& ring, const AssembledState& assembled,
                           std::span<const LoadedPoint> points);
LoadProblem unilateral_problem(const RingCompliance& ring, const AssembledState& assembled,
                               std::span<const LoadedPoint> points);

/// A load state corrected to the exact gap by Newton steps around the LCP: at constant torque or
/// constant rotation.
struct ExactLoad {
  ContactState state;
  int newton_steps = 0;
  double correction_rotation_rad = 0.0; ///< θ(exact) − θ(linearised gaps), at given torque
  double correction_force_n = 0.0;      ///< largest change of a tooth force
  double residual_mm = 0.0;             ///< exact wall gap minus the LCP's, largest
  ContactCertificate certificate;       ///< of the last LCP
  Eigen::MatrixX2d wall_force;          ///< components (radial, circumferential), N
};

enum class Control { rotation, torque };

Outcome<ExactLoad> correct_to_exact_gap(const RingCompliance& ring, const WaveGeneratorSurface& surface,
                                        const AssembledState& assembled, const LoadProblem& load,
                                        const ContactState& start, Control control, ContactSolver& solver);

} // namespace strainwave
