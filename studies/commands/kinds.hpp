#pragma once
// The kinds of study side by side: who makes the rows of each, and the names that their files may use.

#include "strainwave/studies/tables/row_study.hpp"

namespace strainwave {

/// The names that study files may use here, for load_study().
StudyVocabulary study_vocabulary();

/// By the maker of the study's kind.
Outcome<SampledStudy> make_rows(const StudyFile& study, const RowOptions& options);

} // namespace strainwave
