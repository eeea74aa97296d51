#pragma once
// Studies whose rows are known in advance, for people and for programs.

#include "strainwave/studies/tables/run.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace strainwave {

/// `folder` as it is to be printed.
std::string sampled_table(const SampledReport& report, const std::string& folder);

/// The object of `study run --json`; a bound that does not exist becomes null.
nlohmann::ordered_json sampled_json(const SampledReport& report, const std::string& folder);

/// "complete", "enough", "stopped", "time_limit", "all_failed", "too_many_failed"
std::string_view run_end_name(RunEnd end);

} // namespace strainwave
