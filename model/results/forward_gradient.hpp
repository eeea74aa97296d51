#pragma once
// Derivatives of a forward result, per unit of the gear file's keys: N per µm, rad per mm.

#include <Eigen/Core>

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

} // namespace strainwave
