#pragma once
// Rows of a sweep: gears whose keys run through lists of values.

#include "strainwave/studies/tables/row_study.hpp"

namespace strainwave {

Outcome<SampledStudy> make_sweep_rows(const StudyFile& study, const RowOptions& options);

} // namespace strainwave
