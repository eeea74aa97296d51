#include "strainwave/common/sampling/morris_points.hpp"

#include "strainwave/common/sampling/counter_random.hpp"
#include "strainwave/common/sampling/permutation.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace strainwave {

MorrisPoints::MorrisPoints(std::uint64_t seed, int inputs, std::uint64_t trajectories, int levels)
    : inputs_(static_cast<std::size_t>(inputs)), seed_(seed), trajectories_(trajectories), levels_(levels) {
  if (inputs < 1 || trajectories < 2)
    throw std::invalid_argument("Morris screening needs at least one source and two trajectories");
  if (levels < 2 || levels % 2 != 0)
    throw std::invalid_argument(
        fmt::format("Morris screening wants an even number of levels, got {}", levels));
}

// The level of an input decides its direction: from the lower half up, from the upper half down.
std::vector<double> MorrisPoints::start(std::uint64_t trajectory) const {
  std::vector<double> u(inputs_);
  random_uniforms({seed_, RandomPurpose::morris}, trajectory, u);
  for (double& x : u) {
    const int level = std::min(static_cast<int>(x * levels_), levels_ - 1);
    x = (level + 0.5) / levels_;
  }
  return u;
}

std::vector<MorrisPoints::Step> MorrisPoints::steps(std::uint64_t trajectory) const {
  const std::vector<double> u = start(trajectory);
  const Permutation order(inputs_, random_block({seed_, RandomPurpose::morris}, trajectory, 0, 1));
  std::vector<Step> steps(inputs_);
  for (std::size_t s = 0; s < inputs_; ++s) {
    const std::size_t input = order(s);
    steps[s] = {input, u[input] < 0.5 ? 0.5 : -0.5};
  }
  return steps;
}

void MorrisPoints::points(std::uint64_t first, std::size_t count, std::span<double> uniforms) const {
  const std::size_t rows = inputs_ + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t trajectory = (first + i) / rows;
    std::vector<double> u = start(trajectory);
    const std::vector<Step> taken = steps(trajectory);
    for (std::size_t s = 0; s < (first + i) % rows; ++s)
      u[taken[s].input] += taken[s].change;
    std::ranges::copy(u, uniforms.begin() + static_cast<std::ptrdiff_t>(i * inputs_));
  }
}

} // namespace strainwave
