#include "strainwave/model/meshing/assembled_backlash.hpp"

#include "strainwave/common/core/units.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace strainwave {

namespace {

using units::degree;
constexpr double none = std::numeric_limits<double>::infinity();

/// Angle and value of the least f in [lo, hi], f unimodal there; to 1e-7 of the interval. Not Boost's
/// brent_find_minima: f is infinite where flanks do not overlap, and a parabola through that steps to no
/// number.
template <class F>
std::pair<double, double> golden_section(const F& f, double lo, double hi) {
  constexpr double part = 0.3819660112501051;
  double a = lo + part * (hi - lo), b = hi - part * (hi - lo);
  double fa = f(a), fb = f(b);
  for (int step = 0; step < 34; ++step) {
    if (fa <= fb) {
      hi = std::exchange(b, a);
      fb = fa;
      a = lo + part * (hi - lo);
      fa = f(a);
    } else {
      lo = std::exchange(a, b);
      fa = fb;
      b = hi - part * (hi - lo);
      fb = f(b);
    }
  }
  return fa <= fb ? std::pair{a, fa} : std::pair{b, fb};
}

} // namespace

std::vector<double> backlash_sections(const Flexspline& fs, int count) {
  const double end = fs.cup_length_mm - fs.front_clearance_mm;
  std::vector<double> z;
  for (int k = 0; k < count; ++k)
    z.push_back(end - fs.face_width_mm * (1.0 - static_cast<double>(k) / (count - 1)));
  return z;
}

AssembledBacklash assembled_backlash(const AssembledPoses& poses, const std::vector<FlankPair>& flanks,
                                     const std::vector<double>& z_mm, std::span<const double> phi_rad,
                                     double teeth_ratio) {
  AssembledBacklash result;
  result.z_mm = z_mm;
  for (const double phi : phi_rad)
    result.phi_deg.push_back(phi / degree);
  double least = none;
  for (std::size_t k = 0; k < z_mm.size(); ++k) {
    const auto at = [&](double phi) {
      const ToothBacklash b = flanks[k].drive(poses.between(phi, static_cast<int>(k)), phi * teeth_ratio);
      return b.overlap ? b.backlash_mm : none;
    };
    std::vector<double> row;
    std::size_t first = 0;
    double least_of_row = none;
    for (std::size_t i = 0; i < phi_rad.size(); ++i) {
      const double c = at(phi_rad[i]);
      row.push_back(std::isfinite(c) ? 1e3 * c : std::numeric_limits<double>::quiet_NaN());
      if (c < least_of_row) {
        least_of_row = c;
        first = i;
      }
    }
    result.backlash_um.push_back(std::move(row));
    if (!std::isfinite(least_of_row))
      continue;
    const auto [phi, c] = golden_section(at, phi_rad[first > 0 ? first - 1 : 0],
                                         phi_rad[std::min(first + 1, phi_rad.size() - 1)]);
    const double best = std::min(c, least_of_row);
    if (best < least) {
      least = best;
      result.min_um = 1e3 * best;
      result.min_phi_deg = (c <= least_of_row ? phi : phi_rad[first]) / degree;
      result.min_z_mm = z_mm[k];
    }
  }
  if (!std::isfinite(least))
    result.min_um = std::numeric_limits<double>::quiet_NaN();
  return result;
}

} // namespace strainwave
