#include "strainwave/common/sampling/sobol_points.hpp"

#include "strainwave/common/sampling/counter_random.hpp"

#include <bit>
#include <boost/random/sobol.hpp>
#include <fmt/format.h>
#include <stdexcept>

namespace strainwave {

namespace {

constexpr std::size_t bits = 32;

/// Row r of the random lower-triangular matrix: ones on the diagonal, random bits before it. Digits count
/// from the most significant bit.
std::uint32_t matrix_row(std::uint32_t random, std::size_t row) {
  const std::uint32_t diagonal = 0x80000000U >> row;
  const std::uint32_t before = ~((diagonal << 1) - 1);
  return diagonal | (row == 0 ? 0U : random & before);
}

std::uint32_t times(const std::uint32_t (&rows)[bits], std::uint32_t digits) {
  std::uint32_t product = 0;
  for (std::size_t r = 0; r < bits; ++r)
    product |= static_cast<std::uint32_t>(std::popcount(rows[r] & digits) & 1) << (31 - r);
  return product;
}

} // namespace

std::vector<std::uint32_t> sobol_directions(int dimensions) {
  using Engine = boost::random::sobol_engine<std::uint_least32_t, 32>;
  const auto n = static_cast<std::size_t>(dimensions);
  std::vector<std::uint32_t> directions(bits * n);
  Engine engine(n);
  // Boost leaves out the point 0; its points 2^j − 1 and 2^j differ by the direction of bit j.
  std::vector<std::uint32_t> before(n, 0);
  for (std::size_t j = 0; j < bits; ++j) {
    if (j > 0) {
      engine.seed((std::uint_least32_t{1} << j) - 2);
      for (auto& x : before)
        x = engine();
    } else {
      engine.seed(0);
    }
    for (std::size_t d = 0; d < n; ++d)
      directions[j * n + d] = before[d] ^ engine();
  }
  return directions;
}

SobolPoints::SobolPoints(int dimensions, std::uint64_t seed, std::uint64_t lane)
    : dimensions_(static_cast<std::size_t>(dimensions)) {
  if (dimensions < 1 || dimensions > max_dimensions) {
    throw std::invalid_argument(
        fmt::format("Sobol' points exist for 1 to {} dimensions here, asked for {}; take design = \"random\"",
                    max_dimensions, dimensions));
  }
  directions_ = sobol_directions(dimensions);
  shift_.resize(dimensions_);
  const RandomKey matrix{seed, RandomPurpose::sobol_matrix};
  const RandomKey shift{seed, RandomPurpose::sobol_shift};
  for (std::size_t d = 0; d < dimensions_; ++d) {
    std::uint32_t rows[bits];
    for (std::size_t r = 0; r < bits; ++r)
      rows[r] = matrix_row(static_cast<std::uint32_t>(random_bits(matrix, d, r, lane)), r);
    for (std::size_t j = 0; j < bits; ++j) {
      std::uint32_t& v = directions_[j * dimensions_ + d];
      v = times(rows, v);
    }
    shift_[d] = static_cast<std::uint32_t>(random_bits(shift, d, 0, lane));
  }
}

void SobolPoints::points(std::uint64_t first, std::size_t count, std::span<double> uniforms) const {
  const std::size_t n = dimensions_;
  std::vector<std::uint32_t> state(shift_);
  const std::uint64_t gray = first ^ (first >> 1);
  for (std::size_t j = 0; j < bits; ++j)
    if ((gray >> j) & 1)
      for (std::size_t d = 0; d < n; ++d)
        state[d] ^= directions_[j * n + d];
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t d = 0; d < n; ++d)
      uniforms[i * n + d] = (static_cast<double>(state[d]) + 0.5) * 0x1p-32;
    const auto j = static_cast<std::size_t>(std::countr_zero(first + i + 1));
    if (j < bits)
      for (std::size_t d = 0; d < n; ++d)
        state[d] ^= directions_[j * n + d];
  }
}

} // namespace strainwave
