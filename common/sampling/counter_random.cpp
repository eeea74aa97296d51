#include "strainwave/common/sampling/counter_random.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#include <Random123/philox.h>
#pragma GCC diagnostic pop

namespace strainwave {

std::array<std::uint64_t, 4> random_block(const RandomKey& key, std::uint64_t sample, std::uint64_t block,
                                          std::uint64_t lane) {
  const r123::Philox4x64 philox;
  const r123::Philox4x64::ctr_type counter{{sample, block, lane, 0}};
  const r123::Philox4x64::key_type words{{key.seed, static_cast<std::uint64_t>(key.purpose)}};
  const auto result = philox(counter, words);
  return {result[0], result[1], result[2], result[3]};
}

std::uint64_t random_bits(const RandomKey& key, std::uint64_t sample, std::uint64_t dimension,
                          std::uint64_t lane) {
  return random_block(key, sample, dimension / 4, lane)[dimension % 4];
}

void random_uniforms(const RandomKey& key, std::uint64_t sample, std::span<double> uniforms,
                     std::uint64_t lane) {
  for (std::size_t d = 0; d < uniforms.size(); d += 4) {
    const auto words = random_block(key, sample, d / 4, lane);
    for (std::size_t i = 0; i < 4 && d + i < uniforms.size(); ++i)
      uniforms[d + i] = open_uniform(words[i]);
  }
}

} // namespace strainwave
