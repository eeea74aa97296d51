#pragma once
// How a single contact changes with the numbers of the gear file: its gap, its distance from the gear's axis,
// its place on the flexspline's flank and the direction of its normal, all at once, for any pose.
//
// The gap formula (flank_gap.hpp) is evaluated once in numbers that carry derivatives, at the place where the
// contact is: at a fixed height of the flexspline's flank, at an edge or kink, which moves with its own
// parameters, or at an inner least gap, which moves so that the slope of the gap stays zero, dt/dp =
// −(∂²gap/∂t∂p)/(∂²gap/∂t²). Poses come with their own derivatives, from the neutral curve or from the
// assembled cup alike.
//
// backlash_gradient.hpp answers for all teeth of a table; this class for the few contacts that carry load.

#include "strainwave/model/tooth/backlash.hpp"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace strainwave {

/// A pose and its derivatives: lines ρ [mm], φ1, θ_n [rad]; a column for each parameter.
struct PoseSlopes {
  Pose value;
  Eigen::Matrix3Xd by;
};

/// Where on the flank the contact is taken.
struct ContactSpot {
  std::optional<double>
      height; ///< fixed h on the flexspline; absent: the place below (which says whose normal it is anyway)
  ContactPlace place = ContactPlace::flank;
  int kink = 0;
  double roll =
      0.0; ///< on the flexspline: of the inner least gap, a first guess for edges of the circular spline
  bool coast = false; ///< the mirrored flank; pose and space angle are still those of the tooth itself
};

/// Values and derivatives, one entry for each parameter, per unit of its key in the file.
struct ContactSlopes {
  double gap_mm = 0.0, radius_mm = 0.0, height = 0.0, pressure_angle_rad = 0.0;
  Eigen::VectorXd gap, radius, height_slope, pressure_angle;
};

/// The keys that act through the flanks themselves: profile shifts, radii and modifications
/// (backlash_gradient.hpp names them too; the wave generator's act through the poses).
bool is_flank_parameter(const Gear&, const std::string& path);

class FlankSlopes {
public:
  /// Flanks at face coordinate zeta. Parameters that are not of the flanks get what the poses hand on.
  FlankSlopes(const Gear&, std::span<const std::string> parameters, double zeta);
  ~FlankSlopes();
  FlankSlopes(FlankSlopes&&) noexcept;

  /// pose.by has a column for each parameter. Arguments as of FlankPair::drive.
  ContactSlopes at(const PoseSlopes& pose, double space_angle_rad, const ContactSpot& spot) const;

private:
  struct Passes;
  std::unique_ptr<const Passes> passes_;
};

} // namespace strainwave
