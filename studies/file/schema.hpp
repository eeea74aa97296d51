#pragma once
// JSON Schema and reference page of study files, made from the tables of the kinds.

#include "strainwave/studies/file/study.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace strainwave {

/// Draft 2020-12. One branch for each kind of study, because kinds differ in their tables.
nlohmann::ordered_json study_json_schema(StudyKinds kinds);

/// docs/study-file.md
std::string study_reference_page(StudyKinds kinds);

} // namespace strainwave
