#pragma once
// Closed forms of the radial displacement u(phi), 0 <= phi <= pi/2 (even, period pi), each with u' and u''.
//
// Two discs: thin inextensible ring on two symmetric contact arcs, small displacements. Wrap angle gamma,
// eps = pi/2 - gamma, x = pi/2 - phi:
//     A1 = eps - sin eps cos eps      B1 = (4/pi)(sin eps - eps cos eps)      k = u0/(A1 - B1)
//     on the disc:  u = k (A1 cos phi - B1)
//     free:         u = k [(1 - cos eps)^2 + (x sin x - 2 (1 - cos x)) + sin^2 eps (1 - cos x) - B1]
// The free part equals (1 + sin^2 gamma) sin phi + (pi/2 - phi) cos phi - 2 sin gamma - B1, written so that
// nothing of order one cancels when gamma nears pi/2 (A1 - B1 ~ eps^3).
// Four forces at +-beta and opposite: ring under concentrated loads.
// Cosine: u0 cos 2 phi.
// Ellipse: semi-axes r_m + u0 and b; u = radius at the polar angle phi, less r_m.

#include "strainwave/model/kinematics/derivative.hpp"

#include <numbers>

namespace strainwave {

/// u [mm] and its derivatives with respect to the polar angle.
template <class T>
struct Displacement {
  T u;
  T first;
  T second;
};

/// sin x - x cos x, to full relative accuracy (x^3/3 for small x).
template <class T>
T sin_less_x_cos(const T& x) {
  using std::cos, std::sin;
  if (std::abs(value_of(x)) > 0.5)
    return T(sin(x) - x * cos(x));
  const T square = x * x;
  T term = x * square * (1.0 / 6.0),
    sum = term * 2.0; // term = x^(2n+1)/(2n+1)!, with its sign; summand 2n term
  for (int n = 2; n <= 9; ++n) {
    term = T(term * square) * (-1.0 / ((2 * n) * (2 * n + 1)));
    sum += T(term * (2.0 * n));
  }
  return sum;
}

/// x sin x - 2 (1 - cos x), to full relative accuracy (-x^4/12 for small x).
template <class T>
T x_sin_less_two_versine(const T& x) {
  using std::cos, std::sin;
  if (std::abs(value_of(x)) > 0.5)
    return T(x * sin(x) - 2.0 * (1.0 - cos(x)));
  const T square = x * x;
  T term = square * square * (-1.0 / 24.0), sum = term * 2.0; // (-1)^n x^(2n+2)/(2n+2)!, summand 2n term
  for (int n = 2; n <= 9; ++n) {
    term = T(term * square) * (-1.0 / ((2 * n + 1) * (2 * n + 2)));
    sum += T(term * (2.0 * n));
  }
  return sum;
}

/// x - sin x cos x, to full relative accuracy (2 x^3/3 for small x).
template <class T>
T x_less_sin_cos(const T& x) {
  using std::sin;
  const T y = 2.0 * x;
  if (std::abs(value_of(y)) > 0.5)
    return T(0.5 * (y - sin(y)));
  const T square = y * y;
  T term = y * square * (1.0 / 6.0), sum = term;
  for (int n = 2; n <= 9; ++n) {
    term = T(term * square) * (-1.0 / ((2 * n) * (2 * n + 1)));
    sum += term;
  }
  return T(0.5 * sum);
}

/// A1 and B1 of the two-disc formula for eps = pi/2 - gamma.
template <class T>
struct WrapConstants {
  explicit WrapConstants(const T& eps)
      : a1(x_less_sin_cos(eps)), b1(T(sin_less_x_cos(eps) * (4.0 / std::numbers::pi))) {}
  T a1, b1;
};

template <class T>
struct TwoDisc {
  TwoDisc(const T& u0, const T& gamma) : eps(T(0.5 * std::numbers::pi - gamma)) {
    using std::cos, std::sin;
    const WrapConstants<T> constants(eps);
    a1 = constants.a1;
    b1 = constants.b1;
    k = u0 / T(a1 - b1);
    sine_squared = T(sin(eps) * sin(eps));
    const T half_sine = sin(T(0.5 * eps));
    const T versine = 2.0 * half_sine * half_sine;
    versine_squared = versine * versine;
  }
  Displacement<T> operator()(double phi) const {
    if (phi <= 0.5 * std::numbers::pi - value_of(eps)) {
      const double c = std::cos(phi), s = std::sin(phi);
      return {T(k * (a1 * c - b1)), T(k * a1 * -s), T(k * a1 * -c)};
    }
    const double x = 0.5 * std::numbers::pi - phi, s = std::sin(x), half = std::sin(0.5 * x),
                 versine = 2.0 * half * half;
    return {T(k * (versine_squared + x_sin_less_two_versine(x) + sine_squared * versine - b1)),
            T(k * (sin_less_x_cos(x) - sine_squared * s)), T(k * (sine_squared * std::cos(x) - x * s))};
  }
  T eps, a1, b1, k, sine_squared, versine_squared;
};

template <class T>
struct FourForce {
  FourForce(const T& u0, const T& beta_) : beta(beta_) {
    using std::cos, std::sin;
    sine = sin(beta);
    cosine = cos(beta);
    a = T(sine + (0.5 * std::numbers::pi - beta) * cosine);
    k = u0 / T(a - 4.0 / std::numbers::pi);
  }
  Displacement<T> operator()(double phi) const {
    const double c = std::cos(phi), s = std::sin(phi), rest = 0.5 * std::numbers::pi - phi;
    if (phi <= value_of(beta))
      return {T(k * (a * c + sine * (phi * s) - 4.0 / std::numbers::pi)),
              T(k * (a * -s + sine * (s + phi * c))), T(k * (a * -c + sine * (2.0 * c - phi * s)))};
    const T front = cosine + beta * sine;
    return {T(k * (front * s + cosine * (rest * c) - 4.0 / std::numbers::pi)),
            T(k * (front * c + cosine * (-c - rest * s))),
            T(k * (front * -s + cosine * (2.0 * s - rest * c)))};
  }
  T beta, sine, cosine, a, k;
};

template <class T>
struct Cosine {
  explicit Cosine(const T& u0_) : u0(u0_) {}
  Displacement<T> operator()(double phi) const {
    const double c = std::cos(2.0 * phi), s = std::sin(2.0 * phi);
    return {T(u0 * c), T(u0 * (-2.0 * s)), T(u0 * (-4.0 * c))};
  }
  T u0;
};

template <class T>
struct Ellipse {
  Ellipse(const T& neutral_radius, const T& u0, const T& minor)
      : radius(neutral_radius), a(T(neutral_radius + u0)), b(minor) {}
  Displacement<T> operator()(double phi) const {
    using std::sqrt;
    // rho = a b q^(-1/2), q = b^2 cos^2 + a^2 sin^2.
    const double c = std::cos(phi), s = std::sin(phi);
    const T difference = T((a - b) * (a + b));
    const T q = b * b + difference * (s * s);
    const T q1 = difference * (2.0 * s * c), q2 = difference * (2.0 * (c - s) * (c + s));
    const T rho = a * b / T(sqrt(q));
    const T ratio = q1 / q;
    const T first = rho * ratio * -0.5;
    return {T(rho - radius), first, T(rho * (0.75 * ratio * ratio - 0.5 * q2 / q))};
  }
  T radius, a, b;
};

} // namespace strainwave
