#pragma once
// Units: factors with their names, and how results.h5 spells units (HDF5 has none of its own, and no micro
// sign in plain names). Inside the program: mm, N, rad; what people read and write has its unit in its name.

#include <numbers>
#include <string>
#include <string_view>

namespace strainwave {

namespace units {
inline constexpr double pi = std::numbers::pi;
inline constexpr double right_angle = 0.5 * pi;   ///< rad
inline constexpr double degree = pi / 180.0;      ///< rad
inline constexpr double arcsec = degree / 3600.0; ///< rad
inline constexpr double mm_per_um = 1e-3;
} // namespace units

inline std::string plain_unit(std::string_view unit) {
  if (unit == "µm")
    return "um";
  if (unit == "N·m")
    return "N.m";
  if (unit == "N·m/rad")
    return "N.m/rad";
  return unit.empty() ? "1" : std::string(unit);
}

} // namespace strainwave
