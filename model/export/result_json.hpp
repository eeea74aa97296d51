#pragma once
// A forward result as the JSON object of `analyze --json`: keys and units as docs/results.md lists them; NaN
// becomes null.

#include "strainwave/model/results/result.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace strainwave {

nlohmann::ordered_json result_json(const ForwardResult& result);

/// The same, as text with two blanks of indentation.
std::string result_json_text(const ForwardResult& result);

std::string_view name(StageStatus status);

} // namespace strainwave
