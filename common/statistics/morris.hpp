#pragma once
// Morris screening: which of many inputs matter at all.
//
// Elementary effect of an input: change of the output per unit of u over one step of MorrisPoints. mu is
// their mean, mu_star the mean of their magnitudes (Campolongo, Cariboni, Saltelli, Environ. Model. Softw.
// 22, 2007), sigma their spread: large sigma against mu_star says that the effect is curved or depends on
// other inputs. A trajectory with a failed row is dropped whole and counted.

#include "strainwave/common/sampling/morris_points.hpp"
#include "strainwave/common/statistics/interval.hpp"

namespace strainwave {

struct MorrisEffect {
  Estimate mu, mu_star; ///< intervals by Student's t over trajectories
  double sigma = 0.0;
};

struct MorrisResult {
  std::uint64_t trajectories = 0;
  std::uint64_t dropped_trajectories = 0;
  std::vector<MorrisEffect> inputs;
};

/// Values and status (0: ok) of all rows. Throws std::invalid_argument with fewer than 2 whole trajectories.
MorrisResult morris_effects(const MorrisPoints&, std::span<const double> values,
                            std::span<const std::uint8_t> status);

} // namespace strainwave
