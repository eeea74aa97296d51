#pragma once
// A forward result as the JSON object of `analyze --json`: keys and units of result_fields.hpp; NaN
// becomes null.

#include "strainwave/model/results/result.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace strainwave {

nlohmann::ordered_json result_json(const ForwardResult& result);

/// The same, as text with two blanks of indentation.
std::string result_json_text(const ForwardResult& result);

} // namespace strainwave
