#pragma once
// Rows of a sensitivity study: one input of the indices for each source.

#include "strainwave/studies/tables/row_study.hpp"

namespace strainwave {

Outcome<SampledStudy> make_sensitivity_rows(const StudyFile& study, const RowOptions& options);

} // namespace strainwave
