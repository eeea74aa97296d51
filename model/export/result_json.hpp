#pragma once
// A forward result as the JSON object of `analyze --json`: keys and units of result_fields.hpp; NaN
// becomes null.

#include "strainwave/model/results/load_path.hpp"
#include "strainwave/model/results/result.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace strainwave {

/// `path`, where there is one, as the object "path".
nlohmann::ordered_json result_json(const ForwardResult& result, const LoadPath* path = nullptr);

/// The same, as text with two blanks of indentation.
std::string result_json_text(const ForwardResult& result, const LoadPath* path = nullptr);

} // namespace strainwave
