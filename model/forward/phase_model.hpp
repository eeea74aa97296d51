#pragma once
// One meshing phase of the loaded pair: the teeth with their backlash, the cup assembled at this phase, and the LCP made
// from both. Solves single loads; what the whole analysis makes of them is forward.cpp's business.

#include "model/contact/load_problem.hpp"
#include "model/gear/gear.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace strainwave {

/// One load at one phase. Arrays run over PhaseModel::teeth().
struct PhaseLoad {
  double rotation_rad = 0.0;
  double torque_nm = 0.0; ///< all lobes
  double tangent_nm_per_rad = 0.0;
  std::vector<double> force_n;
  std::vector<double> loaded_backlash_um; ///< along the arc, 0 where closed
  double disc_force_n = 0.0;              ///< 0 for fidelity linear
  double gap_correction_rotation_rad = 0.0;
  double gap_correction_force_n = 0.0;
  double exact_gap_residual_um = 0.0;
  double recomputed_gap_um = 0.0; ///< tooth gaps from the forces through the unit responses, against the solver's; largest
  double largest_displacement_mm = 0.0; ///< bound of any displacement by a part of the forces: largest unit response · Σ force
  double rounding_um = 0.0;             ///< of a gap (gap_rounding_mm)
  ContactCertificate certificate;
  bool contact = false;
};

class PhaseModel {
public:
  /// `assembled` belongs to this phase. The ring and the surface are kept by reference.
  PhaseModel(const Contact& contact, const RingCompliance& ring, const WaveGeneratorSurface& surface,
             std::shared_ptr<const AssembledState> assembled, std::vector<LoadedTooth> teeth);

  const std::vector<LoadedTooth>& teeth() const { return teeth_; }
  /// take_up: least θ ≥ 0 with contact, min c/R.
  double take_up_rad() const;

  Outcome<PhaseLoad> at_torque(double torque_nm, ContactSolver& solver) const;
  Outcome<PhaseLoad> at_rotation(double rotation_rad, ContactSolver& solver) const;

private:
  ActiveSet assembled_guess() const;
  double recomputed_gap_error(const ContactState& state, const Eigen::MatrixX2d* wall_force) const;
  Outcome<PhaseLoad> finish(const ContactState& start, Control control, ContactSolver& solver) const;

  Contact contact_;
  const RingCompliance& ring_;
  const WaveGeneratorSurface& surface_;
  std::shared_ptr<const AssembledState> assembled_;
  std::vector<LoadedTooth> teeth_;
  LoadProblem load_;
};

} // namespace strainwave
