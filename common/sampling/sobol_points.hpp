#pragma once
// Scrambled Sobol' points in base 2.
//
// Point k is the exclusive or of the direction numbers V_j over the bits j of k's Gray code. The directions
// are Joe and Kuo's (SIAM J. Sci. Comput. 30, 2008) as Boost.Random holds them. Scrambling: a random
// lower-triangular matrix over GF(2) applied to the directions and a random digital shift (Matousek, J.
// Complexity 14, 1998), independent for each dimension. Every scrambled point is uniform, averages over 2^m
// points are unbiased, and their variance is that of Owen's nested scrambling (Owen, ACM TOMACS 13, 2003),
// without any cost per point. 32 bits are kept. Only powers of two of points, counted from 0, form a net:
// other numbers give up what the method is for.

#include <cstdint>
#include <span>
#include <vector>

namespace strainwave {

class SobolPoints {
public:
  /// dimensions 1 … 3667; `lane` numbers independent scramblings of one seed. Throws std::invalid_argument.
  SobolPoints(int dimensions, std::uint64_t seed, std::uint64_t lane);

  /// Points first … first + count − 1 (all below 2^32), row by row, into count × dimensions numbers in (0,
  /// 1).
  void points(std::uint64_t first, std::size_t count, std::span<double> uniforms) const;

  static constexpr int max_dimensions = 3667;

private:
  std::size_t dimensions_;
  std::vector<std::uint32_t> directions_; ///< bit j of dimension d at j * dimensions + d
  std::vector<std::uint32_t> shift_;
};

/// Unscrambled direction numbers, bit j of dimension d at j * dimensions + d.
std::vector<std::uint32_t> sobol_directions(int dimensions);

} // namespace strainwave
