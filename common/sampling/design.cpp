#include "strainwave/common/sampling/design.hpp"

#include "strainwave/common/sampling/counter_random.hpp"
#include "strainwave/common/sampling/permutation.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <stdexcept>

namespace strainwave {

namespace {

void check(const DesignPlan& plan) {
  if (plan.samples == 0 || plan.dimensions < 1)
    throw std::invalid_argument("a design needs at least one sample and one source");
  if (plan.design == SamplingDesign::random)
    return;
  const auto r = static_cast<std::uint64_t>(std::max(plan.randomisations, 0));
  if (r < 2)
    throw std::invalid_argument(fmt::format(
        "intervals of this design come from its randomisations: at least 2 are needed (16 are usual), got {}",
        plan.randomisations));
  if (plan.samples % r != 0)
    throw std::invalid_argument(fmt::format("{} samples cannot be cut into {} equal randomisations; take {}",
                                            plan.samples, r, (plan.samples / r + 1) * r));
  const std::uint64_t per = plan.samples / r;
  if (per > (1ULL << 32))
    throw std::invalid_argument("more than 2^32 samples in one randomisation");
  if (plan.design == SamplingDesign::sobol && !std::has_single_bit(per))
    throw std::invalid_argument(fmt::format(
        "Sobol' designs want a power of two: {} samples in {} randomisations are {} each; take {}",
        plan.samples, r, per, std::bit_ceil(per) * r));
}

} // namespace

SampleDesign::SampleDesign(const DesignPlan& plan) : plan_(plan) {
  check(plan);
  if (plan.design == SamplingDesign::random) {
    plan_.randomisations = 1;
    per_ = plan.samples;
    return;
  }
  per_ = plan.samples / static_cast<std::uint64_t>(plan.randomisations);
  if (plan.design == SamplingDesign::sobol)
    for (int r = 0; r < plan.randomisations; ++r)
      sobol_.emplace_back(plan.dimensions, plan.seed, static_cast<std::uint64_t>(r));
}

void SampleDesign::points(std::uint64_t first, std::size_t count, std::span<double> uniforms) const {
  const auto n = static_cast<std::size_t>(plan_.dimensions);
  if (uniforms.size() != count * n || first + count > plan_.samples)
    throw std::logic_error("SampleDesign::points: asked past the design");
  if (plan_.design == SamplingDesign::random) {
    const RandomKey key{plan_.seed, RandomPurpose::samples};
    for (std::size_t i = 0; i < count; ++i)
      random_uniforms(key, first + i, uniforms.subspan(i * n, n));
    return;
  }
  while (count > 0) { // one randomisation at a time
    const std::uint64_t place = first % per_;
    const std::size_t here = static_cast<std::size_t>(std::min<std::uint64_t>(count, per_ - place));
    if (plan_.design == SamplingDesign::sobol)
      sobol_[first / per_].points(place, here, uniforms.first(here * n));
    else
      hypercube_points(first, here, uniforms.first(here * n));
    first += here;
    count -= here;
    uniforms = uniforms.subspan(here * n);
  }
}

void SampleDesign::hypercube_points(std::uint64_t first, std::size_t count,
                                    std::span<double> uniforms) const {
  const auto n = static_cast<std::size_t>(plan_.dimensions);
  const std::uint64_t lane = first / per_;
  const RandomKey places{plan_.seed, RandomPurpose::hypercube_place};
  for (std::size_t i = 0; i < count; ++i)
    random_uniforms(places, first + i, uniforms.subspan(i * n, n));
  const RandomKey orders{plan_.seed, RandomPurpose::hypercube_order};
  const double width = 1.0 / static_cast<double>(per_);
  for (std::size_t d = 0; d < n; ++d) {
    const Permutation order(per_, random_block(orders, d, 0, lane));
    for (std::size_t i = 0; i < count; ++i) {
      double& u = uniforms[i * n + d];
      u = std::min((static_cast<double>(order((first + i) % per_)) + u) * width, 1.0 - 0x1p-53);
    }
  }
}

} // namespace strainwave
