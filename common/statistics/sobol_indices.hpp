#pragma once
// Sobol' indices: which share of an output's variance comes from which input.
//
// First index of input i: what knowing it alone would remove; total index: what would remain if all others
// were known. With blocks of inputs + 2 rows (Saltelli, Comput. Phys. Commun. 145, 2002: A, B and, for each
// input i, A with coordinate i of B; values a = f(A), b = f(B), c_i = f(that), centred by their common mean):
//     V       variance of all a and b
//     first   mean of b (c_i − a) / V     Saltelli et al., Comput. Phys. Commun. 181 (2010), table 2 (b)
//     total   mean of (a − c_i)² / 2 V    Jansen, Comput. Phys. Commun. 117 (1999)
//
// Intervals: bootstrap over blocks (Archer, Saltelli, Sobol', J. Stat. Comput. Simul. 58, 1997), estimate
// ± 1.96 times the spread of the resampled estimates; for totals (means of squares, skewed) the same on the
// logarithm. For blocks from scrambled Sobol' points they are on the safe side: resampling cannot see that
// such points err less than random ones.
//
// A block with a failed row is dropped whole and counted: the rest is then no longer a sample of the sources
// but of the sources where the model works.

#include "strainwave/common/statistics/interval.hpp"

#include <vector>

namespace strainwave {

struct SobolIndex {
  Estimate first, total;
};

struct SobolIndices {
  std::uint64_t blocks = 0;         ///< blocks that were used
  std::uint64_t dropped_blocks = 0; ///< blocks with a failed row
  double variance = 0.0;
  std::vector<SobolIndex> inputs;
};

struct BootstrapOptions {
  std::uint64_t seed = 1;
  int resamples = 400;
};

/// `values` and `ok` of the first blocks × (inputs + 2) rows of a Saltelli design; ok: 0 is a row with a
/// result (row_ok), all else failed. Throws std::invalid_argument if fewer than 8 whole blocks remain; a
/// constant output has indices 0.
SobolIndices sobol_indices(std::span<const double> values, std::span<const std::uint8_t> status,
                           std::size_t inputs, const BootstrapOptions& = {});

/// The same on 2^m, 2^(m−1), … blocks, at least `least` of them, smallest first: do the indices still move?
std::vector<SobolIndices> nested_sobol_indices(std::span<const double> values,
                                               std::span<const std::uint8_t> status, std::size_t inputs,
                                               std::uint64_t least = 64, const BootstrapOptions& = {});

} // namespace strainwave
