#pragma once
// The exact way of a gear from rest to its largest load: the torque–rotation curve of one meshing phase,
// drive direction, with every event on it. Between two events the curve is a straight line, so events and
// stiffnesses are the whole curve.
//
//     torque |          ___/      an event: a point of a flank (or a place of the wall) begins or ceases to
//            |      __ /          carry; the slope after it is `stiffness_nm_per_rad`
//            |____/
//            +--------------- rotation
//
// Wall gaps are linearised about the assembled cup (with fidelity linear the wall is frozen as assembled);
// for them the path is exact. What the exact gap makes of each load stands beside it.

#include <optional>
#include <vector>

namespace strainwave {

/// A contact point of a flank. Of one lobe when both are alike.
struct PathPoint {
  int tooth = 0;
  double phi_deg = 0.0;
  bool coast = false;           ///< on the coast flank
  double flank_radius_mm = 0.0; ///< on the undeformed flexspline
  double z_mm = 0.0;
};

struct LoadPathChange {
  PathPoint point;
  bool joins = false;       ///< begins to carry; else ceases to
  bool whole_tooth = false; ///< the first point of its flank to carry, or the last
};

struct LoadPathEvent {
  double rotation_rad = 0.0;
  double torque_nm = 0.0;            ///< all lobes
  double stiffness_nm_per_rad = 0.0; ///< after the event
  std::vector<LoadPathChange> changes = {};
  int wall_joins = 0, wall_leaves = 0; ///< stations of the wall that close, that open; 0 with fidelity linear
};

/// A load asked for, on the path and by the direct solution of the same contact problem.
struct LoadOnPath {
  double torque_nm = 0.0;
  double rotation_rad = 0.0;
  double direct_difference = 0.0; ///< relative: larger of rotation (at a rotation: torque) and tooth forces
  /// Present with contact.disc_gap = "exact": its rotation (at a rotation: torque) minus the path's.
  std::optional<double> exact_minus_path_rad = {};
  std::optional<double> exact_minus_path_nm = {};
  bool at_torque = true; ///< a torque was asked for, else a rotation
};

struct LoadPath {
  double phase = 0.0;
  double start_rotation_rad = 0.0;              ///< at rest
  double start_torque_nm = 0.0;                 ///< 0 to rounding
  double start_stiffness_nm_per_rad = 0.0;      ///< 0 for a gear with play
  std::vector<PathPoint> carries_at_start = {}; ///< of a wedged gear
  std::vector<LoadPathEvent> events = {};       ///< ascending rotation and torque
  double end_rotation_rad = 0.0;
  double end_torque_nm = 0.0;
  std::vector<LoadOnPath> loads = {}; ///< of the gear's [load], torques first
  int selections = 0;                 ///< traces until no point of any flank was missed
};

/// On the path; beyond its ends the first and last straight line go on. A torque at which the path is flat:
/// the largest such rotation.
double rotation_at(const LoadPath& path, double torque_nm);
double torque_at(const LoadPath& path, double rotation_rad);

} // namespace strainwave
