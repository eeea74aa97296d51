#pragma once
// Random numbers without a stream: number (seed, purpose, sample, dimension) is looked up, not drawn in turn.
//
// Philox 4x64 with 10 rounds (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3",
// SC11), from the Random123 library. Key = (seed, purpose), counter = (sample, dimension/4, lane, 0); one
// block gives the numbers of four neighbouring dimensions. A purpose separates uses that must not share
// numbers (samples, scrambling, permutations, bootstrap …).

#include <array>
#include <cstdint>
#include <span>

namespace strainwave {

enum class RandomPurpose : std::uint64_t {
  samples = 1,
  hypercube_order = 2,
  hypercube_place = 3,
  sobol_matrix = 4,
  sobol_shift = 5,
  bootstrap = 6,
  morris = 7,
  model = 8, ///< for models that draw numbers of their own
  search_starts = 9,
  descent = 10 ///< where slopes are taken around a kink
};

struct RandomKey {
  std::uint64_t seed = 1;
  RandomPurpose purpose = RandomPurpose::samples;
};

/// Four independent 64-bit numbers.
std::array<std::uint64_t, 4> random_block(const RandomKey&, std::uint64_t sample, std::uint64_t block,
                                          std::uint64_t lane = 0);

/// Number `dimension` of a sample: word dimension % 4 of block dimension / 4.
std::uint64_t random_bits(const RandomKey&, std::uint64_t sample, std::uint64_t dimension,
                          std::uint64_t lane = 0);

/// Open interval: (2 i + 1) 2^-53 with the 52 upper bits i. Never 0, never 1.
inline double open_uniform(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

/// Uniform numbers of dimensions 0 … size − 1 of one sample.
void random_uniforms(const RandomKey&, std::uint64_t sample, std::span<double> uniforms,
                     std::uint64_t lane = 0);

} // namespace strainwave
