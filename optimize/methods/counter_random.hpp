#pragma once
// Random numbers as a pure function of counters (seed, index, dimension): no stream that threads would share,
// and the k-th number does not depend on how many were drawn before.

#include <cstdint>

namespace strainwave {

/// Well mixed, in [0, 1) (finaliser of SplitMix64: G. Steele, D. Lea, C. Flood, OOPSLA 2014).
inline double counter_random(std::uint64_t seed, std::uint64_t index, std::uint64_t dimension) {
  const auto mix = [](std::uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  };
  return static_cast<double>(mix(mix(mix(seed) + index) + dimension) >> 11) * 0x1.0p-53;
}

} // namespace strainwave
