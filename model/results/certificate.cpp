#include "strainwave/model/results/result.hpp"

#include <fmt/format.h>

#include <cmath>

namespace strainwave {

std::optional<std::string> Certificate::find_flaw() const {
  struct Limit {
    const char* name;
    double value, limit;
  };
  const Limit limits[] = {{"complementarity", complementarity, 1e-9},
                          {"min_gap_um", -min_gap_um, 1e-6 + rounding_um},
                          {"min_force_n", -min_force_n, 1e-9},
                          {"reciprocity", reciprocity, 1e-10},
                          {"equilibrium", equilibrium, 1e-9},
                          {"exact_gap_residual_um", exact_gap_residual_um, 1e-6 + rounding_um}};
  for (const Limit& one : limits) {
    if (one.value <= one.limit)
      continue;
    if (std::isnan(one.value))
      return fmt::format("{} is undefined, at most {:.2g} is allowed", one.name, one.limit);
    return fmt::format("{} is off by {:.3g}, at most {:.2g} is allowed", one.name, one.value, one.limit);
  }
  return std::nullopt;
}

} // namespace strainwave
