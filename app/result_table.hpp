#pragma once
// A forward result for people: what `analyze` prints on a terminal without --json.

#include "strainwave/model/results/load_path.hpp"
#include "strainwave/model/results/result.hpp"

#include <string>

namespace strainwave::app {

std::string result_table(const ForwardResult& result);

/// What --path adds: a line for every event at which a tooth begins or ceases to carry, the others counted.
std::string path_table(const LoadPath& path);

} // namespace strainwave::app
