#pragma once

namespace strainwave {

/// Of the program; keep in step with CMakeLists.txt (a test compares).
inline constexpr const char* version = "0.1.0";

} // namespace strainwave
