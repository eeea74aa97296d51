#pragma once
// Points for Sobol' indices of functions of a few numbers: blocks of inputs + 2 rows.
//
// Block j holds A_j, B_j and, for each input i, A_j with its coordinate i taken from B_j (Saltelli, Comput.
// Phys. Commun. 145, 2002; 181, 2010). A and B are the two halves of one point of 2 × inputs coordinates. Row
// k belongs to block k / (inputs + 2).

#include "strainwave/common/sampling/counter_random.hpp"
#include "strainwave/common/sampling/design.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace strainwave::testing_support {

class SaltelliPoints {
public:
  /// SamplingDesign::sobol or SamplingDesign::random; `base`: how many blocks, a power of two.
  SaltelliPoints(SamplingDesign design, std::uint64_t seed, int inputs, std::uint64_t base)
      : inputs_(static_cast<std::size_t>(inputs)), base_(base), seed_(seed) {
    if (design == SamplingDesign::sobol)
      sobol_.emplace(2 * inputs, seed, 0);
  }

  std::uint64_t rows() const { return base_ * (inputs_ + 2); }
  std::uint64_t base() const { return base_; }
  std::size_t inputs() const { return inputs_; }
  /// Rows first … first + count − 1 of `inputs` numbers in (0, 1).
  void points(std::uint64_t first, std::size_t count, std::span<double> uniforms) const {
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

private:
  std::size_t inputs_;
  std::uint64_t base_, seed_;
  std::optional<SobolPoints> sobol_;
};

} // namespace strainwave::testing_support
