#pragma once
// A design of samples: which point of the unit cube sample k is.
//
//   random           every coordinate by itself from Philox.
//   latin_hypercube  within one randomisation of n points every coordinate visits each of the n intervals
//                    [i/n, (i + 1)/n) once (McKay, Beckman, Conover, Technometrics 21, 1979).
//   sobol            scrambled Sobol' points; the number per randomisation is a power of two.
//
// The last two are not independent samples, so their intervals come from R independent randomisations: sample
// k is point k % (N/R) of randomisation k / (N/R); see statistics/interval.hpp. Random samples have R = 1.

#include "strainwave/common/sampling/sobol_points.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace strainwave {

enum class SamplingDesign { random, latin_hypercube, sobol };

struct DesignPlan {
  SamplingDesign design = SamplingDesign::random;
  std::uint64_t seed = 1;
  std::uint64_t samples = 0; ///< N
  int dimensions = 0;
  int randomisations = 16; ///< R; does not matter for SamplingDesign::random
};

class SampleDesign {
public:
  /// Throws std::invalid_argument with one sentence: N/R not whole or (sobol) no power of two, R < 2, too
  /// many.
  explicit SampleDesign(const DesignPlan&);

  const DesignPlan& plan() const { return plan_; }
  std::uint64_t per_randomisation() const { return per_; }
  int randomisation_of(std::uint64_t sample) const { return static_cast<int>(sample / per_); }

  /// Samples first … first + count − 1, row by row; numbers in (0, 1). Any cut into calls gives the same
  /// bits.
  void points(std::uint64_t first, std::size_t count, std::span<double> uniforms) const;

private:
  void hypercube_points(std::uint64_t first, std::size_t count, std::span<double> uniforms) const;
  DesignPlan plan_;
  std::uint64_t per_ = 1;
  std::vector<SobolPoints> sobol_; ///< one for each randomisation
};

} // namespace strainwave
