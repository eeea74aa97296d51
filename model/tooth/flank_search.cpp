// The least gap of one tooth: from end to end of the shared flank, through every break of the modifications.

#include "strainwave/model/tooth/prepared_pair.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>

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
                      ? Mark{tooth.t_inner, ContactPlace::flexspline_root}
                      : Mark{roll(prepared.inner_radius), ContactPlace::circular_spline_tip};
  const Mark hi = tip <= prepared.outer_radius
                      ? Mark{tooth.t_outer, ContactPlace::flexspline_tip}
                      : Mark{roll(prepared.outer_radius), ContactPlace::circular_spline_root};
  return Stretch{lo, hi, root, tip};
}

namespace {

/// Sub-intervals of a whole flank without kinks; shorter stretches get their share, at least two. Between
/// them a cubic through values and slopes shows where a minimum hides; the gap is analytic there and its
/// stretches are short against its radius of curvature.
constexpr int samples_per_flank = 4;

/// Goes along the flank from mark to mark and keeps the lowest candidate.
class Search {
public:
  /// `start` is an end of the shared flank, and so a candidate.
  Search(const ToothPair<double>& pair, const Placement<double>& place, const Mark& start)
      : pair_(pair), place_(place), mark_(start), at_mark_(flank_gap(pair, place, start.t)) {
    offer(at_mark_, start);
  }

  /// The smooth stretch from the last mark to this one. The mark itself is a candidate when it is an end or
  /// sharp.
  void go_to(const Mark& to, bool end) {
    const Gap<double> last = flank_gap(pair_, place_, to.t);
    if (end || to.sharp)
      offer(last, to);
    if (to.t > mark_.t) {
      // Where the slope jumps, rounding picks its side: stay a hair off. A minimum in the hair differs from
      // the mark's own value by less than rounding.
      const double hair = 1e-8 * (to.t - mark_.t);
      const double a = mark_.sharp ? mark_.t + hair : mark_.t, b = to.sharp ? to.t - hair : to.t;
      smooth(a, mark_.sharp ? flank_gap(pair_, place_, a) : at_mark_, b,
             to.sharp ? flank_gap(pair_, place_, b) : last);
    }
    mark_ = to;
    at_mark_ = last;
  }

  ToothBacklash best() const { return best_; }

private:
  void smooth(double a, const Gap<double>& at_a, double b, const Gap<double>& at_b) {
    const Flank<double>& flank = pair_.flexspline;
    const double share = (b - a) / (flank.t_outer - flank.t_inner);
    const int samples = std::max(2, static_cast<int>(std::ceil(samples_per_flank * share)));
    const double width = (b - a) / samples;
    double t = a;
    Gap<double> left = at_a;
    for (int k = 1; k <= samples; ++k) {
      const double next = k == samples ? b : a + k * width;
      const Gap<double> right = k == samples ? at_b : flank_gap(pair_, place_, next);
      inside(t, left, next, right, 0);
      t = next;
      left = right;
    }
  }

  void offer(const Gap<double>& at, const Mark& mark) {
    if (best_.overlap && !(at.gap < best_.backlash_mm))
      return;
    best_ = {true, at.gap, at.radius, pair_.flexspline.height_at_roll(mark.t), mark.place, mark.kink, mark.t};
  }

  void inside(double a, const Gap<double>& at_a, double b, const Gap<double>& at_b, int depth) {
    if (at_a.slope < 0.0 && at_b.slope >= 0.0) {
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
    offer(flank_gap(pair_, place_, t), {t, ContactPlace::flank});
  }

  const ToothPair<double>& pair_;
  const Placement<double>& place_;
  Mark mark_;
  Gap<double> at_mark_;
  ToothBacklash best_;
};

} // namespace

ToothBacklash least_gap(const FlankPair::Prepared& prepared, const Placement<double>& place) {
  const auto stretch = shared_stretch(prepared, place);
  if (!stretch)
    return {};
  const auto& [lo, hi, root_radius, tip_radius] = *stretch;
  Search search(prepared.pair, place, lo);
  if (!prepared.flexspline_breaks.empty() || !prepared.circular_spline_breaks.empty()) {
    std::vector<Mark> marks;
    int index = 0;
    for (const auto& b : prepared.flexspline_breaks)
      marks.push_back({b.at, ContactPlace::flexspline_kink, index++, b.sharp});
    index = 0;
    for (const auto& b : prepared.circular_spline_breaks) {
      if (b.at > root_radius && b.at < tip_radius)
        marks.push_back({roll_at(prepared, place, root_radius, tip_radius, b.at),
                         ContactPlace::circular_spline_kink, index, b.sharp});
      ++index;
    }
    std::stable_sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.t < b.t; });
    // Breaks of two modifications at one place are one break, and sharp if one of them is: the other's smooth
    // side would take a minimum at the jump of the slope for one that can move.
    const double same = 1e-12 * (prepared.pair.flexspline.t_outer - prepared.pair.flexspline.t_inner);
    for (std::size_t k = 1; k < marks.size();) {
      if (marks[k].t - marks[k - 1].t > same) {
        ++k;
        continue;
      }
      marks.erase(marks.begin() +
                  static_cast<std::ptrdiff_t>(marks[k].sharp && !marks[k - 1].sharp ? k - 1 : k));
    }
    for (const Mark& mark : marks)
      if (mark.t > lo.t && mark.t < hi.t)
        search.go_to(mark, false);
  }
  search.go_to(hi, true);
  return search.best();
}

} // namespace strainwave
