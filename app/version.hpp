#pragma once
#include <string_view>

namespace strainwave::app {

/// "0.1.0"
std::string_view program_version();

} // namespace strainwave::app
