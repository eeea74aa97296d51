#pragma once
// One meshing phase of the loaded pair: the points that may carry load, with their backlash, the cup
// assembled at this phase, and the LCP made from both. Solves single loads; what the whole analysis makes of
// them is load_cases.hpp's business.
//
// With many points a tooth (heights × slices) most of them never touch, and coast flanks touch only when the
// gear is wedged or bent far. The LCP then holds a selection: at first the drive flanks' point of least
// take-up of the half of all tooth slices that touch first, and those of the coast flanks that overlap when
// both sides are rigid. After a solve the gap of every other point, drive and coast, is computed from the
// forces; those that would penetrate join, until none does. So no contact can be missed, and the result is
// the solution of the whole problem.

#include "strainwave/model/contact/load_problem.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/meshing/meshing_phase.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace strainwave {

/// One load at one phase. Arrays run over PhaseModel::points(), those with coast_ over
/// PhaseModel::coast_points().
struct PhaseLoad {
  double rotation_rad = 0.0;
  double torque_nm = 0.0; ///< all lobes
  double tangent_nm_per_rad = 0.0;
  std::vector<double> force_n;
  std::vector<double> gap_um; ///< loaded, along the arc; 0 where closed
  std::vector<double> coast_force_n;
  std::vector<double> coast_gap_um;
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
  /// `assembled` belongs to this phase. The ring and the surface are kept by reference. `coast`: points of
  /// the coast flanks (the ring's responses then hold both flanks); without them drive flanks alone are
  /// candidates.
  PhaseModel(const Contact& contact, const RingCompliance& ring, const WaveGeneratorSurface& surface,
             std::shared_ptr<const AssembledState> assembled, std::vector<LoadedPoint> points,
             std::vector<LoadedPoint> coast = {});

  const std::vector<LoadedPoint>& points() const { return drive_; }
  const std::vector<LoadedPoint>& coast_points() const { return coast_; }
  /// Drive points, then coast points, and the forces of a load in the same order.
  const std::vector<LoadedPoint>& all_points() const { return points_; }
  static std::vector<double> all_forces(const PhaseLoad& load);
  /// Least θ ≥ 0 with contact, min c/R.
  double take_up_rad() const;
  /// The same without the bound at 0: negative when drive flanks overlap at θ = 0.
  double least_take_up_rad() const;
  /// By how much drive and coast flanks overlap at whatever rotation, rad: the first coast touch, −min c/R of
  /// the coast flanks, minus the first drive touch. Above 0 no rotation is free of load: the gear is wedged.
  double overlap_rad() const;

  /// A torque of 0 is the take-up or, wedged, the rotation at rest.
  Outcome<PhaseLoad> at_torque(double torque_nm, ContactSolver& solver) const;
  Outcome<PhaseLoad> at_rotation(double rotation_rad, ContactSolver& solver) const;

  /// The points in play and their LCP.
  struct Selection {
    std::vector<int> index; ///< into all_points(), ascending
    std::vector<LoadedPoint> points;
    LoadProblem load;
  };
  Selection select(std::vector<int> index) const;
  /// That every load starts with.
  const Selection& first_selection() const { return first_; }
  /// Gap along F of all points from a state of a selection's LCP (wall gaps linearised), mm.
  Eigen::VectorXd gaps(const Selection& selection, const ContactState& state) const;

private:
  /// A solved selection; forces of its points, components of the wall forces (unilateral).
  struct Solved {
    ContactState state;
    Eigen::MatrixX2d wall_force;
    PhaseLoad load;
  };

  std::vector<int> first_points() const;
  std::vector<int> least_of_tooth_slices(bool coast) const;
  Outcome<PhaseLoad> solve(Control control, double value, ContactSolver& solver) const;
  Outcome<Solved> solve_selection(const Selection& selection, Control control, double value,
                                  const ActiveSet& warm, bool exact, ContactSolver& solver) const;
  /// Along the assembly's normals, fidelity unilateral.
  Eigen::MatrixX2d linearised_wall_force(const ContactState& state) const;
  /// The same with the wall forces given (unused with the wall frozen).
  Eigen::VectorXd gaps(const Selection& selection, const ContactState& state,
                       const Eigen::MatrixX2d& wall_force) const;

  Contact contact_;
  const RingCompliance& ring_;
  const WaveGeneratorSurface& surface_;
  std::shared_ptr<const AssembledState> assembled_;
  std::vector<LoadedPoint> drive_, coast_;
  std::vector<LoadedPoint> points_;          ///< drive, then coast
  std::vector<ToothFunctional> functionals_; ///< of points_
  ActiveSet start_set_; ///< first guess of the first selection's closed set, wall included
  Selection first_;
};

} // namespace strainwave
