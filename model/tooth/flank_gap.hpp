#pragma once
// The gap between one flexspline flank and its circular-spline space, for any scalar. Internal to this room.
//
// Involute by its roll angle t (tan of the pressure angle at the point; the source text's s is t - tan
// alpha0), in the frame of the tooth, w = sigma - t, sigma = theta_h + inv alpha0:
//     P(t) = r_b (1 + i t) exp(i w),      tangent exp(i w),      normal i exp(i w)
// Removal by m along the normal changes only the length along it:
//     flexspline         Q = exp(i w) (r_b + i (r_b t - m)) + (a + i b)
//     circular spline    P = exp(i w) (r_b + i (r_b t + m)),      |P|^2 = r_b^2 + (r_b t + m)^2
// (a, b) = (rho cos theta_n - r_m, -rho sin theta_n) moves the tooth with its pose, seen in a frame that
// turns with the tooth; tau = space angle - phi1 - theta_n is the direction of the space in that frame. At
// the radius rho_p = |Q(t)| the circular-spline flank has the roll angle t2 and the length l2 along its
// normal:
//     l2 = sqrt(rho_p^2 - r_b2^2) = r_b2 t2 + m2(t2)
//     gap(t) = rho_p [tau + sigma2 - t2 + arctan(l2/r_b2) - arg Q(t)]

#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/derivative.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/tooth/backlash.hpp"
#include "strainwave/model/tooth/removal.hpp"

#include <numbers>
#include <type_traits>

namespace strainwave {

/// One member's flank: involute, its two end circles and its modification.
template <class T>
struct Flank {
  T base, sigma;
  T inner_radius, span; ///< h = (radius - inner_radius)/span
  T t_inner, t_outer;   ///< roll angle at the end circles (not below the base circle)
  RemovalLaw<T> removal;

  void set(const T& pitch_radius, const T& alpha, const T& shift, int teeth, const T& inner, const T& outer) {
    using std::cos, std::tan;
    const T tangent = tan(alpha);
    base = pitch_radius * cos(alpha);
    sigma = T(0.5 * std::numbers::pi + 2.0 * shift * tangent) * (1.0 / teeth) + T(tangent - alpha);
    inner_radius = inner;
    span = outer - inner;
    t_inner = roll_at_radius(inner);
    t_outer = roll_at_radius(outer);
  }
  T roll_at_radius(const T& radius) const {
    using std::sqrt;
    const T ratio = radius / base;
    const T square = ratio * ratio - 1.0;
    if (value_of(square) <= 0.0)
      return T(0.0);
    return sqrt(square);
  }
  T radius_at_roll(const T& t) const {
    using std::sqrt;
    return T(base * sqrt(T(1.0 + t * t)));
  }
  T roll_at_height(const T& h) const { return roll_at_radius(T(inner_radius + h * span)); }
  T height_at_roll(const T& t) const { return T(T(radius_at_roll(t) - inner_radius) / span); }
  /// Removal at roll angle t and its derivative with respect to t.
  Removed<T> removed(const T& t) const {
    if (removal.absent)
      return {removal.lead, T(0.0)};
    const T radius = radius_at_roll(t);
    const Removed<T> m = removal.at(T(T(radius - inner_radius) / span));
    return {m.depth, T(m.slope * base * base * t / T(radius * span))};
  }
};

template <class T>
struct ToothPair {
  Flank<T> flexspline, circular_spline;
};

template <class T>
struct Placement {
  T a, b, tau;
};

template <class T>
Placement<T> place_tooth(const T& rho, const T& phi1, const T& normal_rotation, const T& neutral_radius,
                         const T& space_angle) {
  using std::cos, std::sin;
  return {T(rho * cos(normal_rotation) - neutral_radius), T(-rho * sin(normal_rotation)),
          T(space_angle - phi1 - normal_rotation)};
}

/// Point of the flexspline flank in the turned frame, derivative with respect to t, distance from the gear's
/// axis.
template <class T>
struct FlankPoint {
  T x, y, dx, dy, radius, dradius;
};

template <class T>
FlankPoint<T> flank_point(const Flank<T>& flank, const Placement<T>& place, const T& t) {
  using std::cos, std::sin, std::sqrt;
  const Removed<T> m = flank.removed(t);
  const T angle = flank.sigma - t;
  const T c = cos(angle), s = sin(angle), way = flank.base * t - m.depth;
  FlankPoint<T> p;
  p.x = flank.base * c - way * s + place.a;
  p.y = flank.base * s + way * c + place.b;
  p.dx = way * c + m.slope * s;
  p.dy = way * s - m.slope * c;
  p.radius = sqrt(T(p.x * p.x + p.y * p.y));
  p.dradius = T(p.x * p.dx + p.y * p.dy) / p.radius;
  return p;
}

/// Newton steps for unknown x in numbers T: until a change of 1e-9 says that the next one would be rounding,
/// then once more where there are derivatives, which follow one step behind.
template <class T, class Correction>
T newton(T x, const Correction& correction) {
  bool last = false;
  for (int step = 0; step < 60; ++step) {
    const T change = correction(x);
    x -= change;
    if (last)
      break;
    last = std::abs(value_of(change)) < 1e-9 * (1.0 + std::abs(value_of(x)));
    if (std::is_same_v<T, double> && last)
      break;
  }
  return x;
}

/// Roll angle of the circular-spline flank point whose distance along the normal is l2.
template <class T>
T circular_spline_roll(const Flank<T>& flank, const T& way) {
  if (flank.removal.absent)
    return T(T(way - flank.removal.lead) / flank.base);
  return newton(T(way / flank.base), [&](const T& t) {
    const Removed<T> m = flank.removed(t);
    return T(T(flank.base * t + m.depth - way) / T(flank.base + m.slope));
  });
}

/// Radius of the circular-spline flank point of roll angle t.
template <class T>
T circular_spline_radius(const Flank<T>& flank, const T& t) {
  using std::sqrt;
  const T way = flank.base * t + flank.removed(t).depth;
  return sqrt(T(flank.base * flank.base + way * way));
}

template <class T>
struct Gap {
  T gap, slope, radius; ///< slope: d gap/dt
};

template <class T>
Gap<T> flank_gap(const ToothPair<T>& pair, const Placement<T>& place, const T& t) {
  using std::atan2, std::sqrt;
  const FlankPoint<T> p = flank_point(pair.flexspline, place, t);
  const Flank<T>& space = pair.circular_spline;
  const T square = T(p.radius - space.base) * T(p.radius + space.base);
  const T way = value_of(square) > 0.0 ? T(sqrt(square)) : T(0.0);
  const T t2 = circular_spline_roll(space, way);
  const T angle = place.tau + space.sigma - t2 + arctan(T(way / space.base)) - atan2(p.y, p.x);
  const T dway = value_of(square) > 0.0 ? T(p.radius * p.dradius / way) : T(0.0);
  const T dangle = space.base * dway / T(p.radius * p.radius) -
                   dway / T(space.base + space.removed(t2).slope) -
                   T(p.x * p.dy - p.y * p.dx) / T(p.radius * p.radius);
  return {T(p.radius * angle), T(p.dradius * angle + p.radius * dangle), p.radius};
}

/// Roll angle of the flexspline flank point at this distance from the gear's axis.
template <class T>
T roll_at_world_radius(const Flank<T>& flank, const Placement<T>& place, const T& radius, double start) {
  return newton(T(start), [&](const T& t) {
    const FlankPoint<T> p = flank_point(flank, place, t);
    return T(T(p.radius - radius) / p.dradius);
  });
}

} // namespace strainwave
