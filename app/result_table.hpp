#pragma once
// A forward result for people: what `analyze` prints on a terminal without --json.

#include "strainwave/model/results/result.hpp"

#include <string>

namespace strainwave::app {

std::string result_table(const ForwardResult& result);

} // namespace strainwave::app
