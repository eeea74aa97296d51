#pragma once
// Points for Morris screening (Technometrics 33, 1991): trajectories of inputs + 1 rows on a grid of `levels`
// levels.
//
// Each step of a trajectory moves one input, in a random order, by half the range up or down. Levels stand in
// the middle of their cells, u = (level + ½)/levels, so that unbounded distributions stay finite. The step is
// +½ or −½ of u.

#include <cstdint>
#include <span>
#include <vector>

namespace strainwave {

class MorrisPoints {
public:
  /// levels even, at least 2. Throws std::invalid_argument.
  MorrisPoints(std::uint64_t seed, int inputs, std::uint64_t trajectories, int levels = 4);

  std::uint64_t rows() const { return trajectories_ * (inputs_ + 1); }
  std::size_t inputs() const { return inputs_; }
  void points(std::uint64_t first, std::size_t count, std::span<double> uniforms) const;

  /// Step s (0 … inputs − 1) of a trajectory: between its rows s and s + 1.
  struct Step {
    std::size_t input;
    double change; ///< of u: +½ or −½
  };
  std::vector<Step> steps(std::uint64_t trajectory) const;

private:
  std::vector<double> start(std::uint64_t trajectory) const;
  std::size_t inputs_;
  std::uint64_t seed_, trajectories_;
  int levels_;
};

} // namespace strainwave
