#include "strainwave/common/sampling/permutation.hpp"

#include <bit>

namespace strainwave {

namespace {

/// Finaliser of MurmurHash3 (Appleby): every bit of the argument reaches every bit of the result.
std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x85ebca6bU;
  x = (x ^ (x >> 13)) * 0xc2b2ae35U;
  return x ^ (x >> 16);
}

} // namespace

Permutation::Permutation(std::uint64_t n, const std::array<std::uint64_t, 4>& keys) : n_(n) {
  const int bits = std::bit_width(n - 1);
  low_bits_ = bits / 2;
  low_mask_ = static_cast<std::uint32_t>((1ULL << low_bits_) - 1);
  high_mask_ = static_cast<std::uint32_t>((1ULL << (bits - low_bits_)) - 1);
  for (std::size_t i = 0; i < 4; ++i) {
    keys_[2 * i] = static_cast<std::uint32_t>(keys[i]);
    keys_[2 * i + 1] = static_cast<std::uint32_t>(keys[i] >> 32);
  }
}

std::uint64_t Permutation::operator()(std::uint64_t place) const {
  do {
    auto low = static_cast<std::uint32_t>(place) & low_mask_;
    auto high = static_cast<std::uint32_t>(place >> low_bits_);
    for (std::size_t round = 0; round < 8; round += 2) {
      high ^= mixed(low + keys_[round]) & high_mask_;
      low ^= mixed(high + keys_[round + 1]) & low_mask_;
    }
    place = (static_cast<std::uint64_t>(high) << low_bits_) | low;
  } while (place >= n_);
  return place;
}

} // namespace strainwave
