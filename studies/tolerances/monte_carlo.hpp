#pragma once
// Rows of a Monte Carlo study: sample k of the design through all sources.

#include "strainwave/studies/tables/row_study.hpp"

namespace strainwave {

Outcome<SampledStudy> make_monte_carlo_rows(const StudyFile& study, const RowOptions& options);

} // namespace strainwave
