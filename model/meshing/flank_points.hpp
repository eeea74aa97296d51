#pragma once
// The points that may carry load over the whole flank: teeth × heights × slices across the face, each with
// its own gap.
//
// Heights are those of the unit responses' hats on the undeformed flexspline flank (root … tip), as far as
// the circular spline has a flank there. The circular spline's tip edge lies between two of them: where it
// touches the flank is one more point, which replaces the nearest height above it when that is closer than
// half a step (two loads on the same two hats could not be told apart). The flexspline's tip edge is the last
// height.
//
// Gaps are arcs at the point's radius, from one of two sources of poses:
//   kinematic   the neutral curve, the same section at every slice;
//   assembled   the finite-element assembly on the wave generator: each slice of each tooth has the pose of
//   the neutral
//               surface there, with finite displacements u (outwards) and v:
//                   ρ = √((r_m + u)² + v²),   φ1 = φ + atan2(v, r_m + u),   tooth direction φ + rotation
//                   about the axis.

#include "strainwave/model/contact/load_problem.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/tooth/backlash.hpp"

#include <functional>
#include <vector>

namespace strainwave {

/// Pose of a tooth (material angle of its own lobe, in (−π/2, π/2]) at slice k of the face.
using PoseSource = std::function<Pose(int sector, double phi_rad, int slice)>;

/// Poses of every tooth of the period at chosen places along the axis, from the assembled cup.
class AssembledPoses {
public:
  AssembledPoses(const RingCompliance& ring, const AssembledState& assembled, double neutral_radius_mm,
                 double phase, std::vector<double> z_mm);
  /// At a tooth centre of the ring. phi is folded to the lobe around the major axis.
  Pose pose(int sector, double phi_rad, int slice) const;
  /// At any material angle of the first lobe: displacements interpolated between the four nearest tooth
  /// centres.
  Pose between(double phi_rad, int slice) const;
  /// Radial displacement at the same places, mm.
  double radial(double phi_rad, int slice) const;

private:
  struct Displacement {
    double u = 0.0, v = 0.0, rotation = 0.0;
  };
  Displacement interpolated(double phi_rad, int slice) const;
  Pose standing(double phi_rad, const Displacement& d) const;

  int period_;
  double pitch_, phase_, neutral_radius_;
  int first_sector_ = 0;                      ///< of `at_`; sectors ascend
  std::vector<std::vector<Displacement>> at_; ///< [slice][sector − first]
};

/// Where along the axis the gap of a slice is taken: the centroid of its hat, because what is compared with
/// the gap is the mean displacement over the hat. The outer hats are halves, a third of a step inside the
/// face's ends.
std::vector<double> slice_places(const UnitResponses& responses);

/// Flank coordinate at which the gap of height `level` of `levels` ≥ 2 is taken: the height itself, but for
/// the tip's half hat its centroid, a third of the step inside. Load and displacement are the hat's either
/// way.
double gap_height(int level, int levels);

/// ζ of a place along the axis: −1 at the diaphragm's end of the face, +1 at the open end.
double face_coordinate(const Flexspline& flexspline, double z_mm);

/// All points of the given teeth. `flanks`: one FlankPair for each slice (lead modifications differ).
std::vector<LoadedPoint> flank_points(const Gear& gear, const UnitResponses& responses, const Backlash& teeth,
                                      const std::vector<FlankPair>& flanks, const PoseSource& pose);

} // namespace strainwave
