#pragma once
// One meshing phase of the loaded pair: the points that may carry load, with their backlash, the cup assembled at this
// phase, and the LCP made from both. Solves single loads; what the whole analysis makes of them is load_cases.hpp's business.
//
// With many points a tooth (heights × slices) most of them never touch. The LCP then holds a selection: at first the point
// of least take-up of the half of all tooth slices that touch first. After a solve the gap of every other point is computed
// from the forces; those that would penetrate join, until none does. So no contact can be missed, and the result is the
// solution of the whole problem.

#include "model/contact/load_problem.hpp"
#include "model/gear/gear.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace strainwave {

/// One load at one phase. Arrays run over PhaseModel::points().
struct PhaseLoad {
  double rotation_rad = 0.0;
  double torque_nm = 0.0; ///< all lobes
  double tangent_nm_per_rad = 0.0;
  std::vector<double> force_n;
  std::vector<double> gap_um;  ///< loaded, along the arc; 0 where closed
  double disc_force_n = 0.0;   ///< 0 for fidelity linear
  Eigen::MatrixX2d wall_force; ///< (radial, circumferential) at the assembly's stations, N
  double gap_correction_rotation_rad = 0.0;
  double gap_correction_force_n = 0.0;
  double exact_gap_residual_um = 0.0;
  double recomputed_gap_um =
      0.0; ///< gaps from the forces through the unit responses, against the solver's; largest
  double largest_displacement_mm =
      0.0; ///< bound of any displacement by a part of the forces: largest unit response · Σ force
  double rounding_um = 0.0; ///< of a gap (gap_rounding_mm)
  ContactCertificate certificate;
  bool contact = false;
  int rounds = 1; ///< selections tried
};

class PhaseModel {
public:
  /// `assembled` belongs to this phase. The ring and the surface are kept by reference.
  PhaseModel(const Contact& contact, const RingCompliance& ring, const WaveGeneratorSurface& surface,
             std::shared_ptr<const AssembledState> assembled, std::vector<LoadedPoint> points);

  const std::vector<LoadedPoint>& points() const { return points_; }
  /// Least θ ≥ 0 with contact, min c/R.
  double take_up_rad() const;
  /// The same without the bound at 0: negative when flanks interfere.
  double least_take_up_rad() const;

  Outcome<PhaseLoad> at_torque(double torque_nm, ContactSolver& solver) const;
  Outcome<PhaseLoad> at_rotation(double rotation_rad, ContactSolver& solver) const;

private:
  /// The points in play and their LCP.
  struct Selection {
    std::vector<int> index; ///< into points_, ascending
    std::vector<LoadedPoint> points;
    LoadProblem load;
  };
  /// A solved selection; forces of its points, components of the wall forces (unilateral).
  struct Solved {
    ContactState state;
    Eigen::MatrixX2d wall_force;
    PhaseLoad load;
  };

  Selection select(std::vector<int> index) const;
  std::vector<int> first_selection() const;
  Outcome<PhaseLoad> solve(Control control, double value, ContactSolver& solver) const;
  Outcome<Solved> solve_selection(const Selection& selection, Control control, double value,
                                  const ActiveSet& warm, ContactSolver& solver) const;
  /// Gap along F of any points from the forces of a solved selection, mm.
  Eigen::VectorXd gaps(std::span<const LoadedPoint> of, const Selection& selection,
                       const Solved& solved) const;

  Contact contact_;
  const RingCompliance& ring_;
  const WaveGeneratorSurface& surface_;
  std::shared_ptr<const AssembledState> assembled_;
  std::vector<LoadedPoint> points_;
  Selection first_;
};

} // namespace strainwave
