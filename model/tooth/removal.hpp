#pragma once
// flank_modification.hpp's formulas for any scalar, in mm. Internal to this room.

#include "strainwave/model/kinematics/derivative.hpp"
#include "strainwave/model/tooth/flank_modification.hpp"

#include <algorithm>
#include <vector>

namespace strainwave {

/// Removal and its derivative with respect to h.
template <class T>
struct Removed {
  T depth;
  T slope;
};

/// A place where the removal is not smooth; sharp: its slope jumps (else only a higher derivative does).
template <class T>
struct Break {
  T height;
  bool sharp;
};

/// Second derivatives at equidistant knots (spacing w) of the natural spline, times w^2/6: linear in the knot
/// values.
template <class T>
std::vector<T> spline_bends(const std::vector<T>& knots) {
  const std::size_t n = knots.size();
  std::vector<T> bend(n, T(0.0));
  if (n < 3)
    return bend;
  // bend[i-1] + 4 bend[i] + bend[i+1] = second difference.
  std::vector<double> above(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double pivot = 4.0 - above[i - 1];
    above[i] = 1.0 / pivot;
    bend[i] = T(T(knots[i - 1] - 2.0 * knots[i] + knots[i + 1]) - bend[i - 1]) * (1.0 / pivot);
  }
  for (std::size_t i = n - 1; i-- > 1;)
    bend[i] -= T(above[i] * bend[i + 1]);
  return bend;
}

template <class T>
T power_of(const T& x, const T& exponent) {
  using std::exp, std::log;
  return exp(T(exponent * log(x)));
}
inline double power_of(double x, double exponent) {
  return exponent == 1.0 ? x
                         : std::pow(x, exponent); // the usual power is 2; the same bits, a tenth of the time
}

/// The keys of one member at one section, as numbers of type T [mm, -].
template <class T>
struct RemovalLaw {
  bool on_tip_side_down = false; ///< circular spline: q = 1 - h
  T tip_relief{0.0}, tip_start{0.5}, tip_power{2.0}, root_relief{0.0}, root_start{0.5}, crowning{0.0},
      slope{0.0};
  T lead_crowning{0.0}, lead_taper{0.0}, end_relief{0.0}, end_length{0.0};
  T face_width{0.0};
  double zeta = 0.0;
  std::vector<T> knots, bends;
  T lead{0.0}; ///< what does not depend on h
  bool absent = true;

  /// Call after the fields are set.
  void prepare() {
    bends = spline_bends(knots);
    lead = lead_crowning * (zeta * zeta);
    lead += value_of(lead_taper) >= 0.0 ? T(lead_taper * (0.5 * (1.0 + zeta)))
                                        : T(lead_taper * (-0.5 * (1.0 - zeta)));
    for (double side : {-1.0, 1.0}) {
      const T distance = face_width * (0.5 * (1.0 - side * zeta));
      if (value_of(distance) < value_of(end_length)) {
        const T rest = 1.0 - T(distance / end_length);
        lead += T(end_relief * rest * rest);
      }
    }
  }

  Removed<T> at(const T& h) const {
    Removed<T> sum{lead, T(0.0)};
    if (absent)
      return sum;
    const double turn = on_tip_side_down ? -1.0 : 1.0; // dq/dh
    const T q = on_tip_side_down ? T(1.0 - h) : T(h);
    if (value_of(q) > value_of(tip_start)) {
      const T span = 1.0 - tip_start;
      const T x = T(q - tip_start) / span;
      const T lower = power_of(x, T(tip_power - 1.0));
      sum.depth += T(tip_relief * x * lower);
      sum.slope += T(turn * tip_relief * tip_power * lower / span);
    }
    if (value_of(q) < value_of(root_start)) {
      const T x = T(root_start - q) / root_start;
      sum.depth += T(root_relief * x);
      sum.slope -= T(turn * root_relief / root_start);
    }
    const T middle = 2.0 * h - 1.0;
    sum.depth += T(crowning * middle * middle);
    sum.slope += T(4.0 * crowning * middle);
    if (value_of(slope) >= 0.0)
      sum.depth += T(slope * h);
    else
      sum.depth += T(slope * T(h - 1.0));
    sum.slope += slope;
    add_spline(h, sum);
    return sum;
  }

  /// Flank coordinates where the removal is not smooth, in a fixed order.
  std::vector<Break<T>> breaks() const {
    std::vector<Break<T>> list;
    const auto height = [&](const T& q) { return on_tip_side_down ? T(1.0 - q) : T(q); };
    if (value_of(tip_relief) != 0.0)
      list.push_back({height(tip_start), value_of(tip_power) == 1.0});
    if (value_of(root_relief) != 0.0)
      list.push_back({height(root_start), true});
    for (std::size_t i = 1; i + 1 < knots.size(); ++i)
      list.push_back({T(static_cast<double>(i) / static_cast<double>(knots.size() - 1)), false});
    return list;
  }

private:
  void add_spline(const T& h, Removed<T>& sum) const {
    if (knots.empty())
      return;
    if (knots.size() == 1) {
      sum.depth += knots[0];
      return;
    }
    const double intervals = static_cast<double>(knots.size() - 1);
    const double place = std::clamp(std::floor(value_of(h) * intervals), 0.0, intervals - 1.0);
    const auto i = static_cast<std::size_t>(place);
    const T b = intervals * h - place;
    const T a = 1.0 - b;
    const T a2 = a * a, b2 = b * b;
    sum.depth +=
        T(a * knots[i] + b * knots[i + 1]) + T(T(a * a2 - a) * bends[i] + T(b * b2 - b) * bends[i + 1]);
    sum.slope += T(intervals * T(T(knots[i + 1] - knots[i]) +
                                 T(T(3.0 * b2 - 1.0) * bends[i + 1] - T(3.0 * a2 - 1.0) * bends[i])));
  }
};

} // namespace strainwave
