#pragma once
// A random order of 0 … n − 1 that is computed one place at a time.
//
// An alternating Feistel network on the least number of bits that holds n − 1 is a bijection whatever its
// round function; values past n − 1 are sent through it again until they fall inside ("cycle walking", Black
// and Rogaway, CT-RSA 2002; less than two passes on average). So a Latin hypercube needs no shuffled table,
// and a shard can ask for any place of it.

#include <array>
#include <cstdint>

namespace strainwave {

class Permutation {
public:
  /// n ≥ 1, at most 2^32. `keys`: independent random bits.
  Permutation(std::uint64_t n, const std::array<std::uint64_t, 4>& keys);
  std::uint64_t operator()(std::uint64_t place) const;

private:
  std::uint64_t n_;
  int low_bits_;
  std::uint32_t low_mask_, high_mask_;
  std::array<std::uint32_t, 8> keys_;
};

} // namespace strainwave
