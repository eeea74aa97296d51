#pragma once
// What each stage of the forward model reads of a gear, and nothing else: keys and inputs made from the
// file's numbers.

#include "strainwave/common/threads/stage_memory.hpp"
#include "strainwave/model/gear/gear.hpp"

namespace strainwave {

/// Everything the neutral curve depends on; a table counts by its content.
ContentKey curve_key(const WaveGenerator& wave_generator, const Flexspline& flexspline);

} // namespace strainwave
