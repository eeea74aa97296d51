#pragma once
// Eccentricity, radial deformation and wrap angle of two discs, first order: e/u0 = A1/(A1 - B1) falls as the
// wrap angle gamma grows, from 5.279 at 0 to 2.752 = 1/(1 - 2/pi) at 90 degrees. Only between the two does a
// wrap exist. Towards 90 degrees the free arc shrinks to a kink and the shape's formula has its pole; angles
// within half a degree of it are refused.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/displacement.hpp"

#include <numbers>

namespace strainwave {

inline constexpr double largest_wrap_rad = 89.5 * std::numbers::pi / 180.0;
/// Two given numbers for the same thing (e and the wrap angle) agree when the angles differ by less than
/// this.
inline constexpr double wrap_agreement_deg = 0.01;

/// e/u0 for a wrap angle gamma [rad].
template <class T>
T eccentricity_ratio(const T& gamma) {
  const WrapConstants<T> constants(T(0.5 * std::numbers::pi - gamma));
  return T(constants.a1 / T(constants.a1 - constants.b1));
}

struct Wrap {
  double wrap_angle_rad = 0.0;
  double eccentricity_mm = 0.0;
};

/// The first-order wrap of a wave generator with two discs, from its eccentricity (leading when both are
/// given and agree) or its wrap angle.
Outcome<Wrap> first_order_wrap(const WaveGenerator&);

/// Fails when a wrap angle is given beside an eccentricity and the computed one differs from it.
std::optional<Failure> check_wrap_agreement(const WaveGenerator&, double computed_rad);

} // namespace strainwave
