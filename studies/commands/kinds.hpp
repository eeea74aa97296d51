#pragma once
// The kinds of study that the program knows: one line for each.

#include "strainwave/studies/file/study.hpp"

namespace strainwave {

/// For load_study() and whatever else reads studies.
StudyKinds study_kinds();

} // namespace strainwave
