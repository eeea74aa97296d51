#include "strainwave/model/tooth/profile.hpp"

#include "strainwave/model/tooth/prepared_pair.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace strainwave {
namespace {

Placement<double> placed(const FlankPair& pair, const Pose& pose, double space_angle) {
  return place_tooth(pose.rho_mm, pose.phi1_rad, pose.normal_rotation_rad, pair.prepared().neutral_radius,
                     space_angle);
}

GapPoint gap_point(const FlankPair::Prepared& prepared, const Placement<double>& place, double t) {
  const Gap<double> at = flank_gap(prepared.pair, place, t);
  return {prepared.pair.flexspline.height_at_roll(t), at.radius, at.gap};
}

} // namespace

std::vector<PolarPoint> flank_profile(const FlankPair& pair, Member member, int points) {
  assert(points >= 2);
  const auto& prepared = pair.prepared();
  const bool tooth = member == Member::flexspline;
  const Flank<double>& flank = tooth ? prepared.pair.flexspline : prepared.pair.circular_spline;
  std::vector<PolarPoint> list;
  for (int k = 0; k < points; ++k) {
    const double t = flank.roll_at_height(static_cast<double>(k) / (points - 1));
    const double way = flank.base * t + (tooth ? -1.0 : 1.0) * flank.removed(t).depth;
    list.push_back({std::hypot(flank.base, way), flank.sigma - t + std::atan(way / flank.base)});
  }
  return list;
}

std::vector<PolarPoint> posed_flank_profile(const FlankPair& pair, const Pose& pose, int points) {
  assert(points >= 2);
  const Flank<double>& flank = pair.prepared().pair.flexspline;
  const Placement<double> place = placed(pair, pose, 0.0);
  const double turn = pose.phi1_rad + pose.normal_rotation_rad;
  std::vector<PolarPoint> list;
  for (int k = 0; k < points; ++k) {
    const auto p = flank_point(flank, place, flank.roll_at_height(static_cast<double>(k) / (points - 1)));
    list.push_back({p.radius, turn + std::atan2(p.y, p.x)});
  }
  return list;
}

std::optional<GapPoint> gap_at_height(const FlankPair& pair, const Pose& pose, double space_angle_rad,
                                      double flank_height) {
  const auto& prepared = pair.prepared();
  const GapPoint point = gap_point(prepared, placed(pair, pose, space_angle_rad),
                                   prepared.pair.flexspline.roll_at_height(flank_height));
  if (point.radius_mm < prepared.inner_radius || point.radius_mm > prepared.outer_radius)
    return std::nullopt;
  return point;
}

std::vector<GapPoint> gap_profile(const FlankPair& pair, const Pose& pose, double space_angle_rad,
                                  int points) {
  assert(points >= 2);
  const auto& prepared = pair.prepared();
  const Placement<double> place = placed(pair, pose, space_angle_rad);
  const auto stretch = shared_stretch(prepared, place);
  if (!stretch)
    return {};
  std::vector<GapPoint> list;
  for (int k = 0; k < points; ++k)
    list.push_back(
        gap_point(prepared, place, stretch->lo.t + (stretch->hi.t - stretch->lo.t) * k / (points - 1)));
  return list;
}

} // namespace strainwave
