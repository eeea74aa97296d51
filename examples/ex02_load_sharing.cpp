// Example 2: which teeth carry the torque?
//
//     F  │      ▂ ▅ █ ▇ ▅ ▂          the ring is turned against the fixed wave generator until the contact
//     forces F
//        │    ▁             ▁        of both lobes balance 7 N·m; the cup's own compliance, by finite
//        elements, └──────────────────── φ     decides who carries how much
//
// Sample run:   ex02_load_sharing studies/gallery/seed.toml
//
// Every result brings residuals that prove it; one whose certificate fails has another status.

#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

using namespace strainwave;

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: ex02_load_sharing GEAR.toml\n");
    return 2;
  }
  try {
    Gear gear = load_gear(argv[1]).gear;
    gear.load.torque_nm = {7.0};
    ForwardModel model({.disk_cache = false});
    const ForwardResult result = model.analyze(gear);
    if (result.status != Status::ok) {
      fmt::print(stderr, "{}\n", result.message);
      return 3;
    }
    const LoadResult& load = result.load.front();
    for (std::size_t i = 0; i < load.tooth.size(); ++i)
      if (load.force_n[i] > 0.0)
        fmt::print("tooth {:3} at {:6.2f}° {:7.2f} N {}\n", load.tooth[i], load.phi_deg[i], load.force_n[i],
                   std::string(static_cast<std::size_t>(load.force_n[i]), '#'));
    fmt::print("certificate: equilibrium {:.1e}, smallest force {:.1e} N, smallest gap {:.1e} µm\n",
               result.certificate->equilibrium, result.certificate->min_force_n,
               result.certificate->min_gap_um);
    const auto peak = std::max_element(load.force_n.begin(), load.force_n.end());
    fmt::print("largest meshing force: {:.1f} N on tooth {} of {} that carry\n", load.peak_force_n,
               load.tooth[static_cast<std::size_t>(peak - load.force_n.begin())], load.engaged_count);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
