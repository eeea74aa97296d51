#pragma once
// Errors of a flank's shape as gears: how backlash and contact radius change with them.
//
// Each error is put into the direct geometry as a removal along the flank's normal (profile slope, form,
// wear) or as another value of a key of the gear, a little to both sides, and the difference taken. A removal
// may not add material anywhere, so both sides are offset alike: the offset cancels.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/tolerance/tolerance_source.hpp"
#include "strainwave/model/tooth/backlash.hpp"

namespace strainwave {

/// Flanks with the error at +step and −step.
struct ShapePair {
  FlankPair up, down;
  double step = 0.0; ///< mm, or the unit of the key
};

/// Failures: those of FlankPair::make; not_available for a key that moves more than flanks (the cup, the wave
/// generator).
Outcome<ShapePair> shape_pair(const Gear& gear, const ToleranceSource& source);

/// The gear with the material of this error removed (height of the error in mm) on top of `offset_mm` all
/// over the flank.
Gear with_profile_error(const Gear& gear, const ToleranceSource& source, double error_mm, double offset_mm);

} // namespace strainwave
