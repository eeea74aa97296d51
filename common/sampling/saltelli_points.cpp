#include "strainwave/common/sampling/saltelli_points.hpp"

#include "strainwave/common/sampling/counter_random.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <stdexcept>

namespace strainwave {

SaltelliPoints::SaltelliPoints(SamplingDesign design, std::uint64_t seed, int inputs, std::uint64_t base)
    : inputs_(static_cast<std::size_t>(inputs)), base_(base), seed_(seed) {
  if (inputs < 1)
    throw std::invalid_argument("a sensitivity study needs at least one source");
  if (design == SamplingDesign::latin_hypercube)
    throw std::invalid_argument("Sobol' indices are estimated from design = \"sobol\" or \"random\"");
  if (base < 2 || !std::has_single_bit(base) || base > (1ULL << 32))
    throw std::invalid_argument(fmt::format("Sobol' indices want a power of two of blocks, got {}; take {}",
                                            base,
                                            std::bit_ceil(std::clamp<std::uint64_t>(base, 2, 1ULL << 32))));
  if (design == SamplingDesign::sobol)
    sobol_.emplace(2 * inputs, seed, 0);
}

void SaltelliPoints::points(std::uint64_t first, std::size_t count, std::span<double> uniforms) const {
  std::vector<double> pair(2 * inputs_);
  const std::size_t rows = inputs_ + 2;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t block = (first + i) / rows;
    const std::size_t row = (first + i) % rows;
    if (i == 0 || row == 0) {
      if (sobol_)
        sobol_->points(block, 1, pair);
      else
        random_uniforms({seed_, RandomPurpose::samples}, block, pair);
    }
    const auto to = uniforms.subspan(i * inputs_, inputs_);
    const auto a = std::span(pair).first(inputs_), b = std::span(pair).last(inputs_);
    std::ranges::copy(row == 1 ? b : a, to.begin());
    if (row >= 2)
      to[row - 2] = b[row - 2];
  }
}

} // namespace strainwave
