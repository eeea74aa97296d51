#include "strainwave/model/tooth/flank_curvature.hpp"

#include "strainwave/model/tooth/prepared_pair.hpp"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

/// m'' in roll angle.
double second_slope(const Flank<double>& flank, double t) {
  if (flank.removal.absent)
    return 0.0;
  const double half = 0.002 * (flank.t_outer - flank.t_inner);
  double lo = t - half, hi = t + half;
  for (const Break<double>& at : flank.removal.breaks()) {
    const double kink = flank.roll_at_height(at.height);
    if (kink <= lo || kink >= hi)
      continue;
    lo = kink < t ? kink : kink - 2.0 * half;
    hi = lo + 2.0 * half;
  }
  // just inside, so that a slope that jumps at an end is the one of this side
  const double inside = 1e-9 * half;
  return (flank.removed(hi - inside).slope - flank.removed(lo + inside).slope) / (hi - lo);
}

/// side: +1 flexspline, −1 circular spline; length along the normal l at roll angle t.
double curvature(const Flank<double>& flank, double t, double side) {
  const Removed<double> m = flank.removed(t);
  const double l = flank.base * t - side * m.depth;
  const double square = l * l + m.slope * m.slope;
  return (l * l + side * (l * second_slope(flank, t) - flank.base * m.slope) + 2.0 * m.slope * m.slope) /
         (square * std::sqrt(square));
}

} // namespace

double flexspline_curvature(const FlankPair& pair, double radius_mm) {
  const Flank<double>& flank = pair.prepared().pair.flexspline;
  return curvature(flank, flank.roll_at_radius(radius_mm), 1.0);
}

double circular_spline_curvature(const FlankPair& pair, double radius_mm) {
  const Flank<double>& flank = pair.prepared().pair.circular_spline;
  const double way = std::sqrt(std::max(0.0, (radius_mm - flank.base) * (radius_mm + flank.base)));
  return curvature(flank, circular_spline_roll(flank, way), -1.0);
}

double flank_length_mm(const FlankPair& pair, double radius_mm) {
  const double base = pair.prepared().pair.flexspline.base;
  return std::max(0.0, radius_mm - base) * (radius_mm + base) / (2.0 * base);
}

} // namespace strainwave
