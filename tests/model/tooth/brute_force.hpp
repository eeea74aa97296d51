#pragma once
// The backlash once more, slowly and by other means: both flanks as dense polylines of the source text's
// x(s), y(s), moved along numerically differentiated normals, turned by rotation matrices, intersected circle
// by circle. Error about the square of the point distance. Shares only the pose and removal_mm() with the
// program.

#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/tooth/flank_modification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace strainwave::testing_support {

struct XY {
  double x, y;
};

/// Involute flank of the source text, s from the pitch point.
inline XY involute(double r, double alpha, double theta, double s) {
  return {r * (std::cos(s - theta) + s * std::cos(alpha) * std::sin(s - theta + alpha)),
          r * (-std::sin(s - theta) + s * std::cos(alpha) * std::cos(s - theta + alpha))};
}

/// n points between two radii, removal applied along the normal (towards -y for a tooth, +y for a space).
inline std::vector<XY> flank_polyline(const Gear& gear, Member member, double zeta, int n) {
  const Flexspline& f = gear.flexspline;
  const bool tooth = member == Member::flexspline;
  const int teeth = tooth ? f.teeth : gear.circular_spline.teeth;
  const double shift = tooth ? f.profile_shift : gear.circular_spline.profile_shift;
  const double inner = tooth ? f.root_radius_mm : gear.circular_spline.tip_radius_mm;
  const double outer = tooth ? f.tip_radius_mm : gear.circular_spline.root_radius_mm;
  const double alpha = f.pressure_angle_deg * std::numbers::pi / 180.0, r = 0.5 * f.module_mm * teeth;
  const double theta = (0.5 * std::numbers::pi + 2.0 * shift * std::tan(alpha)) / teeth;
  const auto s_at = [&](double radius) {
    const double c = std::cos(alpha), t = radius * radius / (r * r) - c * c;
    return (-std::sin(alpha) + std::sqrt(std::max(0.0, t))) / c;
  };
  const auto& keys = tooth ? gear.flank_modification.flexspline : gear.flank_modification.circular_spline;
  std::vector<XY> points;
  for (int k = 0; k < n; ++k) {
    const double s = s_at(inner) + (s_at(outer) - s_at(inner)) * k / (n - 1.0);
    const XY p = involute(r, alpha, theta, s);
    const XY a = involute(r, alpha, theta, s - 1e-5), b = involute(r, alpha, theta, s + 1e-5);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double h = (std::hypot(p.x, p.y) - inner) / (outer - inner);
    const double m =
        removal_mm(keys, member, std::clamp(h, 0.0, 1.0), zeta, f.face_width_mm) * (tooth ? -1.0 : 1.0);
    points.push_back({p.x - m * (b.y - a.y) / length, p.y + m * (b.x - a.x) / length});
  }
  return points;
}

struct BruteForce {
  bool overlap = false;
  double backlash_mm = std::numeric_limits<double>::infinity();
  double radius_mm = 0.0;
};

/// The pose moves the material point of the neutral line at (r_m, 0) to (rho, phi1) and turns the tooth.
inline BruteForce brute_force_backlash(const Gear& gear, const Pose& pose, double space_angle,
                                       double zeta = 0.0, int n = 4000) {
  const double turn = pose.phi1_rad + pose.normal_rotation_rad, rm = gear.flexspline.neutral_radius_mm;
  std::vector<XY> tooth = flank_polyline(gear, Member::flexspline, zeta, n);
  for (XY& p : tooth) {
    const double x = p.x - rm, y = p.y;
    p = {pose.rho_mm * std::cos(pose.phi1_rad) + x * std::cos(turn) - y * std::sin(turn),
         pose.rho_mm * std::sin(pose.phi1_rad) + x * std::sin(turn) + y * std::cos(turn)};
  }
  const std::vector<XY> space = flank_polyline(gear, Member::circular_spline, zeta, n);
  const auto radius = [](const XY& p) { return std::hypot(p.x, p.y); };
  const auto angle = [](const XY& p) { return std::atan2(p.y, p.x); };
  // Angle of a polyline (ascending radius) at a radius; false outside.
  const auto angle_at = [&](const std::vector<XY>& line, double rho, double& result) {
    if (rho < radius(line.front()) || rho > radius(line.back()))
      return false;
    const auto above = std::lower_bound(line.begin() + 1, line.end() - 1, rho,
                                        [&](const XY& p, double value) { return radius(p) < value; });
    const XY &a = *(above - 1), &b = *above;
    const double share = (rho - radius(a)) / (radius(b) - radius(a));
    result = angle(a) + share * (angle(b) - angle(a));
    return true;
  };
  BruteForce best;
  const auto look = [&](double rho) {
    double on_tooth = 0.0, on_space = 0.0;
    if (!angle_at(tooth, rho, on_tooth) || !angle_at(space, rho, on_space))
      return;
    const double gap = rho * (on_space + space_angle - on_tooth);
    best.overlap = true;
    if (gap < best.backlash_mm)
      best = {true, gap, rho};
  };
  for (const XY& p : tooth)
    look(radius(p));
  for (const XY& p : space)
    look(radius(p));
  return best;
}

} // namespace strainwave::testing_support
