#pragma once
// Limits of double precision, by the names that the solvers use. Internal to this room.

#include <limits>

namespace strainwave {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace strainwave
