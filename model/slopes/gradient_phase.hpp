#pragma once
// Derivatives of the contact states of one meshing phase, by the implicit function theorem on the sets that
// are closed.
//
//     gap_k = c_k cos α′_k − a_k · U − R_k cos α′_k θ = 0        U = G (P − P_a) − G Σ a_i F_i
//     wall  n · Δu = 0 (linear: as assembly left it), or gap(u) = 0 exactly (unilateral)
//
// with forces held, c, R, height h and α′ of each contact follow from flank_slopes.hpp, the functionals a
// from h and α′, the assembled forces P_a from assembly's own closed set, the surface from
// gradient_surface.hpp. The changes of all forces then come from one factor of the state
// (contact_tangent.hpp), one back-substitution for each parameter: no further contact problem is solved.
// Forces of every point come out together, so that an optimiser can have all of them (epigraph).
//
// At a kink (a point about to open or close with zero force, a contact at a node of the compliance's
// interpolation or at a tie of two places) the derivative is that of the sets as they stand: one of the
// one-sided ones at most.

#include "strainwave/model/contact/contact_tangent.hpp"
#include "strainwave/model/loading/phase_model.hpp"
#include "strainwave/model/slopes/gradient_surface.hpp"
#include "strainwave/model/tooth/flank_slopes.hpp"

#include <map>

namespace strainwave {

/// What belongs to the gear as a whole; all of it outlives the phases.
struct SlopeInputs {
  const Gear& gear;
  const NeutralCurve& curve;
  const RingCompliance& ring;
  const WaveGeneratorSurface& surface;
  const std::vector<FlankPair>& flanks;  ///< one for each slice
  std::vector<FlankSlopes> flank_slopes; ///< the same
  SurfaceSlopes surface_slopes;
  std::vector<std::string> parameters;
};

/// The pose of the neutral curve with its derivatives; zero columns for what does not move it.
PoseSlopes kinematic_slopes(const NeutralCurve& curve, const std::vector<std::string>& parameters,
                            double phi_rad);

/// Derivatives of a PhaseLoad, per unit of the parameters' keys.
struct PhaseLoadSlopes {
  Eigen::MatrixXd force_n; ///< points × parameters
  Eigen::VectorXd rotation_rad, torque_nm, tangent_nm_per_rad, disc_force_n;
};

class PhaseSlopes {
public:
  PhaseSlopes(const SlopeInputs& inputs, std::shared_ptr<const AssembledState> assembled);

  /// Derivatives at given torque or rotation. A state without a closed tooth has those of its take-up.
  /// points: drive and coast ones, with their forces; load: the rest of the state.
  PhaseLoadSlopes of(const std::vector<LoadedPoint>& points, const std::vector<double>& force_n,
                     const PhaseLoad& load, Control control) const;
  /// Of the least c/R of drive points, rad.
  Eigen::VectorXd least_take_up(const std::vector<LoadedPoint>& points) const;
  /// Of the backlash of the assembled cup at any material angle of the first lobe and place along the axis,
  /// mm: a least one, where the angle itself does not matter.
  Eigen::VectorXd assembled_backlash(double phi_rad, double z_mm) const;
  /// Of the contact pressure (pressure.hpp) of a point that carries `pressure_mpa`, MPa; `force` holds the
  /// slopes of all forces.
  Eigen::VectorXd pressure(const std::vector<LoadedPoint>& points, const PhaseLoad& load,
                           const Eigen::MatrixXd& force, std::size_t point, double pressure_mpa) const;
  /// Of the assembled resultant on one disc, N.
  Eigen::VectorXd assembly_force() const;
  /// Of the radial displacement under sector 0 at z, mm, by column of the surface (the shift last).
  std::vector<double> radial(double z_mm) const;

private:
  /// Of a point: c, R, flank radius, α′ (lines) by parameter (columns).
  using PointChange = Eigen::Matrix4Xd;
  struct Closed;

  PoseSlopes pose(const LoadedPoint& point) const;
  /// Lines u, v, rotation, tilt of the neutral surface under a tooth; columns: assembled, then by column of
  /// the surface.
  const Eigen::MatrixXd& section(int tooth, double z_mm) const;
  PoseSlopes standing(double phi_rad, const Eigen::MatrixXd& section) const;
  const PointChange& change(const LoadedPoint& point) const;
  void solve_assembly();
  /// Assembled forces of a column, one line for each station of `closed_`.
  Eigen::MatrixX2d assembled_change(Eigen::Index column) const;

  const SlopeInputs& in_;
  std::shared_ptr<const AssembledState> assembled_;
  Eigen::Index count_; ///< parameters
  std::vector<WallStation> closed_;
  Eigen::MatrixX2d normal_;               ///< of the closed stations
  Eigen::MatrixXd along_, across_, turn_; ///< closed stations × columns of the surface: dλ, f [N], ν [rad]
  mutable std::map<std::pair<int, double>, Eigen::MatrixXd> sections_;
  mutable std::map<std::tuple<int, double, double, bool>, PointChange> changes_;
};

} // namespace strainwave
