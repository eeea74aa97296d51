#include "model/tooth/backlash.hpp"

#include "model/tooth/consistency.hpp"
#include "model/tooth/gear_numbers.hpp"
#include "model/tooth/prepared_pair.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace strainwave {
double roll_at(const FlankPair::Prepared& prepared, const Placement<double>& place, double root_radius,
               double tip_radius, double radius) {
  const Flank<double>& tooth = prepared.pair.flexspline;
  const double share = (radius - root_radius) / (tip_radius - root_radius);
  const double start = tooth.t_inner + share * (tooth.t_outer - tooth.t_inner);
  return std::clamp(roll_at_world_radius(tooth, place, radius, start), tooth.t_inner, tooth.t_outer);
}

std::optional<Stretch> shared_stretch(const FlankPair::Prepared& prepared, const Placement<double>& place) {
  const Flank<double>& tooth = prepared.pair.flexspline;
  const double tip = flank_point(tooth, place, tooth.t_outer).radius;
  const double root = flank_point(tooth, place, tooth.t_inner).radius;
  if (!(tip > prepared.inner_radius && root < prepared.outer_radius))
    return std::nullopt;
  const auto roll = [&](double radius) { return roll_at(prepared, place, root, tip, radius); };
  const Mark lo = root >= prepared.inner_radius
                      ? Mark{tooth.t_inner, ContactPlace::flexspline_root, 0}
                      : Mark{roll(prepared.inner_radius), ContactPlace::circular_spline_tip, 0};
  const Mark hi = tip <= prepared.outer_radius
                      ? Mark{tooth.t_outer, ContactPlace::flexspline_tip, 0}
                      : Mark{roll(prepared.outer_radius), ContactPlace::circular_spline_root, 0};
  return Stretch{lo, hi, root, tip};
}

namespace {

constexpr double pi = std::numbers::pi;

/// Sub-intervals for each smooth stretch. Between them a cubic through values and slopes shows where a
/// minimum hides; the gap is analytic there and its stretches are short against its radius of curvature.
constexpr int samples = 4;

bool is_kink(const Mark& m) {
  return m.place == ContactPlace::flexspline_kink || m.place == ContactPlace::circular_spline_kink;
}

class Search {
public:
  Search(const ToothPair<double>& pair, const Placement<double>& place) : pair_(pair), place_(place) {}

  /// Least gap between two marks; both marks are candidates themselves.
  void stretch(const Mark& from, const Mark& to) {
    const Gap<double> first = flank_gap(pair_, place_, from.t), last = flank_gap(pair_, place_, to.t);
    offer(first, from);
    if (!(to.t > from.t))
      return;
    offer(last, to);
    // At a kink the slope belongs to one side or the other by rounding: stay a hair off. A minimum in between
    // is flat enough to differ from the mark's own value by less than rounding.
    const double hair = 1e-8 * (to.t - from.t);
    const double a = is_kink(from) ? from.t + hair : from.t, b = is_kink(to) ? to.t - hair : to.t;
    const double width = (b - a) / samples;
    double t = a;
    Gap<double> left = is_kink(from) ? flank_gap(pair_, place_, a) : first;
    for (int k = 1; k <= samples; ++k) {
      const double next = k == samples ? b : a + k * width;
      const Gap<double> right = k == samples && !is_kink(to) ? last : flank_gap(pair_, place_, next);
      inside(t, left, next, right, 0);
      t = next;
      left = right;
    }
  }

  ToothBacklash best() const { return best_; }

private:
  void offer(const Gap<double>& at, const Mark& mark) {
    if (best_.overlap && !(at.gap < best_.backlash_mm))
      return;
    best_ = {true, at.gap, at.radius, pair_.flexspline.height_at_roll(mark.t), mark.place, mark.kink, mark.t};
  }

  void inside(double a, const Gap<double>& at_a, double b, const Gap<double>& at_b, int depth) {
    if (at_a.slope < 0.0 && at_b.slope > 0.0) {
      refine(a, at_a, b, at_b);
      return;
    }
    // Without a sign change a dip is still possible where the cubic through both ends has one: look there
    // once more.
    const double width = b - a, mean = (at_b.gap - at_a.gap) / width;
    const double p = 3.0 * (at_a.slope + at_b.slope - 2.0 * mean),
                 q = 2.0 * (3.0 * mean - 2.0 * at_a.slope - at_b.slope);
    const double discriminant = q * q - 4.0 * p * at_a.slope;
    if (depth >= 3 || p == 0.0 || discriminant <= 0.0)
      return;
    const double x = (-q + std::sqrt(discriminant)) / (2.0 * p); // the root with rising slope
    if (!(x > 0.0 && x < 1.0))
      return;
    const double t = a + x * width;
    const Gap<double> middle = flank_gap(pair_, place_, t);
    inside(a, at_a, t, middle, depth + 1);
    inside(t, middle, b, at_b, depth + 1);
  }

  void refine(double a, const Gap<double>& at_a, double b, const Gap<double>& at_b) {
    std::uintmax_t evaluations = 100;
    const auto [lo, hi] = boost::math::tools::toms748_solve(
        [&](double t) { return flank_gap(pair_, place_, t).slope; }, a, b, at_a.slope, at_b.slope,
        boost::math::tools::eps_tolerance<double>(50), evaluations);
    const double t = 0.5 * (lo + hi);
    offer(flank_gap(pair_, place_, t), {t, ContactPlace::flank, 0});
  }

  const ToothPair<double>& pair_;
  const Placement<double>& place_;
  ToothBacklash best_;
};

ToothBacklash least_gap(const FlankPair::Prepared& prepared, const Placement<double>& place) {
  const auto stretch = shared_stretch(prepared, place);
  if (!stretch)
    return {};
  const auto& [lo, hi, root_radius, tip_radius] = *stretch;
  Search search(prepared.pair, place);
  if (prepared.flexspline_breaks.empty() && prepared.circular_spline_breaks.empty()) {
    search.stretch(lo, hi);
    return search.best();
  }
  std::vector<Mark> marks{lo, hi};
  for (std::size_t i = 0; i < prepared.flexspline_breaks.size(); ++i)
    marks.push_back({prepared.flexspline_breaks[i], ContactPlace::flexspline_kink, static_cast<int>(i)});
  for (std::size_t i = 0; i < prepared.circular_spline_breaks.size(); ++i) {
    const double radius = prepared.circular_spline_breaks[i];
    if (radius > root_radius && radius < tip_radius)
      marks.push_back({roll_at(prepared, place, root_radius, tip_radius, radius),
                       ContactPlace::circular_spline_kink, static_cast<int>(i)});
  }
  std::erase_if(marks, [&](const Mark& m) {
    const bool kink =
        m.place == ContactPlace::flexspline_kink || m.place == ContactPlace::circular_spline_kink;
    return kink && !(m.t > lo.t && m.t < hi.t);
  });
  std::stable_sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.t < b.t; });
  for (std::size_t i = 1; i < marks.size(); ++i)
    search.stretch(marks[i - 1], marks[i]);
  return search.best();
}

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
  for (double h : tooth.removal.breaks())
    prepared->flexspline_breaks.push_back(tooth.roll_at_height(h));
  for (double h : space.removal.breaks())
    prepared->circular_spline_breaks.push_back(circular_spline_radius(space, space.roll_at_height(h)));
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
