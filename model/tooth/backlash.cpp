#include "strainwave/model/tooth/backlash.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/tooth/consistency.hpp"
#include "strainwave/model/tooth/gear_numbers.hpp"
#include "strainwave/model/tooth/prepared_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strainwave {
namespace {

using units::pi;

} // namespace

Outcome<FlankPair> FlankPair::make(const Gear& gear, double zeta) {
  if (auto failure = find_flank_contradiction(gear))
    return *failure;
  auto prepared = std::make_shared<Prepared>();
  prepared->pair =
      tooth_pair(gear_numbers<double>(gear), gear.flexspline.teeth, gear.circular_spline.teeth, zeta);
  prepared->neutral_radius = gear.flexspline.neutral_radius_mm;
  prepared->teeth_ratio = static_cast<double>(gear.flexspline.teeth) / gear.circular_spline.teeth;
  prepared->zeta = zeta;
  const Flank<double>& tooth = prepared->pair.flexspline;
  const Flank<double>& space = prepared->pair.circular_spline;
  prepared->inner_radius = circular_spline_radius(space, space.t_inner);
  prepared->outer_radius = circular_spline_radius(space, space.t_outer);
  for (const auto& [h, sharp] : tooth.removal.breaks())
    prepared->flexspline_breaks.push_back({tooth.roll_at_height(h), sharp});
  for (const auto& [h, sharp] : space.removal.breaks())
    prepared->circular_spline_breaks.push_back(
        {circular_spline_radius(space, space.roll_at_height(h)), sharp});
  FlankPair pair;
  pair.prepared_ = std::move(prepared);
  return pair;
}

ToothBacklash FlankPair::drive(const Pose& pose, double space_angle_rad) const {
  return least_gap(*prepared_, place_tooth(pose.rho_mm, pose.phi1_rad, pose.normal_rotation_rad,
                                           prepared_->neutral_radius, space_angle_rad));
}

ToothBacklash FlankPair::coast(const Pose& pose, double space_angle_rad) const {
  return drive({pose.rho_mm, -pose.phi1_rad, -pose.normal_rotation_rad}, -space_angle_rad);
}

Window window_of(const Gear& gear) {
  const auto& window = gear.contact.window_deg;
  if (window.size() != 2)
    return {-0.5 * pi, 0.5 * pi};
  return {window[0] * pi / 180.0, window[1] * pi / 180.0};
}

std::vector<SelectedTooth> selected_teeth(const Gear& gear, double phase) {
  const int teeth = gear.flexspline.teeth;
  const Window window = window_of(gear);
  const bool windowed = gear.contact.window_deg.size() == 2;
  constexpr double rounding = 1e-12;
  std::vector<SelectedTooth> list;
  list.reserve(static_cast<std::size_t>(teeth));
  for (int lobe = 0; lobe <= teeth % 2; ++lobe) {
    // Tooth i of this lobe stands at 2 pi (i + phase)/z1 - lobe pi.
    const double offset = phase - 0.5 * lobe * teeth;
    const int first = static_cast<int>(std::floor(-0.25 * teeth - offset)) - 1;
    for (int i = first; i <= first + teeth / 2 + 4; ++i) {
      const double folded = 2.0 * pi * (i + offset) / teeth;
      if (!(folded > -0.5 * pi + rounding && folded <= 0.5 * pi + rounding))
        continue;
      if (windowed && !(folded >= window.lo - rounding && folded <= window.hi + rounding))
        continue;
      list.push_back({i, lobe, folded});
    }
  }
  return list;
}

Backlash teeth_of_window(const Gear& gear, double phase) {
  Backlash result;
  result.phase = phase;
  for (const SelectedTooth& tooth : selected_teeth(gear, phase)) {
    result.tooth.push_back(tooth.tooth);
    result.lobe.push_back(tooth.lobe);
    result.phi_rad.push_back(tooth.folded_rad + tooth.lobe * pi);
  }
  return result;
}

bool Backlash::interference() const {
  const auto cuts = [](const ToothBacklash& b) { return b.overlap && b.backlash_mm < 0.0; };
  return std::any_of(drive.begin(), drive.end(), cuts) || std::any_of(coast.begin(), coast.end(), cuts);
}

Outcome<Backlash> backlash(const Gear& gear, const NeutralCurve& curve, double phase, double zeta) {
  const auto pair = FlankPair::make(gear, zeta);
  if (!pair)
    return pair.failure();
  const std::vector<SelectedTooth> teeth = selected_teeth(gear, phase);
  Backlash result;
  result.phase = phase;
  result.zeta = zeta;
  const std::size_t n = teeth.size();
  for (auto* list : {&result.tooth, &result.lobe})
    list->reserve(n);
  for (auto* list : {&result.drive, &result.coast})
    list->reserve(n);
  result.phi_rad.reserve(n);
  bool any = false;
  for (const SelectedTooth& tooth : teeth) {
    const Pose pose = curve.pose(tooth.folded_rad);
    const double space = tooth.folded_rad * pair->prepared().teeth_ratio;
    result.tooth.push_back(tooth.tooth);
    result.lobe.push_back(tooth.lobe);
    result.phi_rad.push_back(tooth.folded_rad + tooth.lobe * pi);
    result.drive.push_back(pair->drive(pose, space));
    result.coast.push_back(pair->coast(pose, space));
    any = any || result.drive.back().overlap || result.coast.back().overlap;
  }
  if (teeth.empty() && !gear.contact.window_deg.empty())
    return Failure{
        Status::no_overlap,
        fmt::format(
            "no tooth stands between the angles of contact.window_deg, {} and {} degrees; the pitch is "
            "{:.4g} degrees",
            gear.contact.window_deg.front(), gear.contact.window_deg.back(), 360.0 / gear.flexspline.teeth)};
  if (!any)
    return Failure{
        Status::no_overlap,
        fmt::format("no tooth of the {} looked at reaches the circular spline: flexspline tip_radius_mm {} + "
                    "radial deformation {:.4f} against circular_spline.tip_radius_mm {}",
                    n, gear.flexspline.tip_radius_mm, curve.summary().u0_mm,
                    gear.circular_spline.tip_radius_mm)};
  return result;
}

} // namespace strainwave
