#pragma once
// Derivatives of a forward result with respect to continuous numbers of the gear file, exact through the whole chain: flanks →
// gaps → contact by the implicit function theorem on the closed sets → forces, rotations, stiffness (gradient_phase.hpp).
//
// Exact are all keys that act through flanks, poses and assembly alone: flank_modification.*, circular_spline.profile_shift,
// tip_radius_mm and root_radius_mm, and of the wave generator u0, eccentricity or wrap angle, and disc_taper_um. The others act
// through the finite elements too (cup geometry, material, the flexspline's own tooth, contact_width_mm); who needs them
// takes differences of whole results.
//
// Everything is per unit of the file's key: N per µm, rad per mm.

#include "model/forward/result.hpp"

#include <Eigen/Core>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace strainwave {

struct ForwardGradient {
  std::vector<std::string> parameters;

  /// Of one meshing phase; lines of force_n like PhaseForces::tooth, a column for each parameter.
  struct Phase {
    Eigen::MatrixXd force_n;
    Eigen::VectorXd rotation_rad, torque_nm, tangent_nm_per_rad, disc_force_n;
    Eigen::VectorXd peak_pressure_mpa; ///< of this phase; not a number where nothing carries
    double largest_pressure_mpa = 0.0; ///< the pressure itself
  };
  std::vector<std::vector<Phase>> load; ///< [load of the result][phase]

  Eigen::VectorXd min_backlash_um, assembly_force_n, rim_strain;
  Eigen::VectorXd take_up_rad;                            ///< as in the result: without the part below 0
  Eigen::VectorXd rated_rotation_rad, small_rotation_rad; ///< at the rated torque and at 4 % of it, phase 0
};

/// Whether ForwardSolution::gradient() takes this path for this gear.
bool has_exact_gradient(const Gear& gear, const std::string& path);

class Analysis;

/// An analysis that has come to its end, with its contact states. The ForwardModel has to outlive it.
class ForwardSolution {
public:
  explicit ForwardSolution(std::shared_ptr<Analysis> analysis) : analysis_(std::move(analysis)) {}
  /// Throws std::invalid_argument for a path without exact gradient. One thread at a time.
  ForwardGradient gradient(std::span<const std::string> parameters) const;

private:
  std::shared_ptr<Analysis> analysis_;
};

} // namespace strainwave
