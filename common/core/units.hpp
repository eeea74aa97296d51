#pragma once
// Units as results.h5 spells them: HDF5 has none of its own and no micro sign in plain names.

#include <string>
#include <string_view>

namespace strainwave {

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
