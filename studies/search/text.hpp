#pragma once
// An optimisation for people and for programs: the unmodified gear beside the optimised one.

#include "strainwave/studies/search/optimisation.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace strainwave {

/// `folder` as it is to be printed.
std::string optimisation_table(const OptimisationReport& report, const std::string& folder);

/// The object of `study run --json`; a number that does not exist becomes null.
nlohmann::ordered_json optimisation_json(const OptimisationReport& report, const std::string& folder);

} // namespace strainwave
