#pragma once
// Points for Sobol' indices: blocks of inputs + 2 rows.
//
// Block j holds A_j, B_j and, for each input i, A_j with its coordinate i taken from B_j (Saltelli, Comput.
// Phys. Commun. 145, 2002; 181, 2010). A and B are the two halves of one point of 2 × inputs coordinates. Row
// k belongs to block k / (inputs + 2); a block is used as a whole or not at all. Bases are powers of two, so
// that a study of 2^m blocks contains those of 2^(m−1) as its beginning.

#include "strainwave/common/sampling/design.hpp"

#include <optional>

namespace strainwave {

class SaltelliPoints {
public:
  /// SamplingDesign::sobol or SamplingDesign::random. Throws std::invalid_argument: base no power of two,
  /// other designs.
  SaltelliPoints(SamplingDesign, std::uint64_t seed, int inputs, std::uint64_t base);

  std::uint64_t rows() const { return base_ * (inputs_ + 2); }
  std::uint64_t base() const { return base_; }
  std::size_t inputs() const { return inputs_; }
  /// Rows first … first + count − 1 of `inputs` numbers in (0, 1).
  void points(std::uint64_t first, std::size_t count, std::span<double> uniforms) const;

private:
  std::size_t inputs_;
  std::uint64_t base_, seed_;
  std::optional<SobolPoints> sobol_;
};

} // namespace strainwave
