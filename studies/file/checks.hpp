#pragma once
// Checks of a study after its keys have been read: do its parts fit the gear and each other?

#include "strainwave/model/gear_file/file_error.hpp"
#include "strainwave/studies/file/study.hpp"

#include <map>
#include <string>
#include <vector>

namespace strainwave {

/// Where keys of the file stand: "variable[0].path" → place of its value. Keys that are absent are not in it.
using StudyPlaces = std::map<std::string, Place>;

void check_study(const StudyFile& study, const StudyPlaces& places, const StudyVocabulary& vocabulary,
                 std::vector<FileFault>& faults);

} // namespace strainwave
