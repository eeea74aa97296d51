#pragma once
// The neutral curve of a gear that has one.

#include "strainwave/model/kinematics/neutral_curve.hpp"

namespace strainwave::testing_support {

inline NeutralCurve curve_of(const Gear& gear) {
  return NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
}

} // namespace strainwave::testing_support
