#pragma once
// What a study file means as gears and loads.

#include "strainwave/studies/file/study.hpp"

#include <vector>

namespace strainwave {

/// The loads of a study: cases with the same phases and direction share one analysis.
std::vector<Load> study_loads(const StudyFile& study);

/// The study's gear with the study's loads in its [load], so that an analysis of it gives the study's
/// numbers.
Gear gear_with_loads(const StudyFile& study);

} // namespace strainwave
