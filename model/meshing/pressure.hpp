#pragma once
// Contact pressure of the loaded points: line contact of two cylinders (Hertz; K. L. Johnson, Contact
// Mechanics, 1985, section 4.2(c)).
//
//     w = N / share of the face [N/mm],   E* = E / (2 (1 − ν²)),   1/R = κ_flexspline − κ_circular spline
//     half width b = √(4 w R / (π E*)),   peak pressure p0 = 2 w / (π b)
//
// N is the force along the flank normal: the point's own with flank_normal, F / cos α with a circumferential
// force (α of the circular spline's flank at the contact radius). E and ν are those of [material] for both
// members; the gear file says nothing else of the circular spline.
//
// A point stands for a share of its flank: half of the way to its neighbours in height, the whole flank when
// it is the only one of its tooth and slice. Near φ = 0 the flanks nearly conform, R is some 100 mm (or the
// concave flank is even the more curved one), and Hertz' b exceeds that share. The load cannot spread further
// than the share, for the neighbours carry their own: then b is half of it and the pressure the mean over it,
// w / share:
//     p = max(2 w / (π b), w / share)
//
// An edge (tip of either member) touches with the flank's own curvature here. A sharp edge has a higher
// pressure, in the limit without bound; so there p is a lower bound, and `edge` says so.

#include "strainwave/model/contact/load_problem.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/tooth/backlash.hpp"

#include <map>
#include <vector>

namespace strainwave {

struct LineContact {
  double half_width_mm = 0.0;
  double pressure_mpa = 0.0;
};

/// w ≥ 0 [N/mm], relative curvature 1/R [1/mm] (may be ≤ 0), E* [MPa], share of the flank [mm].
LineContact line_contact(double line_load_n_per_mm, double relative_curvature_per_mm,
                         double contact_modulus_mpa, double share_mm);

/// E* of two bodies of the same material, MPa.
double contact_modulus_mpa(const Material& material);

class FlankPressure {
public:
  explicit FlankPressure(const Gear& gear) : gear_(gear) {}

  /// One entry for each point, zero where force_n is. Points of one tooth stand together, as flank_points
  /// makes them.
  std::vector<LineContact> of(const std::vector<LoadedPoint>& points, const std::vector<double>& force_n);

private:
  const FlankPair& flanks_at(double z_mm);

  Gear gear_;
  std::map<double, FlankPair> flanks_; ///< by place along the axis: lead modifications differ
};

} // namespace strainwave
