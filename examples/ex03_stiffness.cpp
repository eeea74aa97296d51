// Example 3: the torque–rotation curve.
//
//     T │            ╱      at first nothing touches (take-up); then tooth after tooth joins, and the curve
//     stiffens
//       │         ╱         (wind-up). Secant stiffness: rated torque by its wind-up. Lost motion: the width
//       of the │     _.-'          hysteresis-free loop at ± 4 % of the rated torque. └─────────────── θ
//
// Sample run:   ex03_stiffness studies/gallery/seed.toml
//
// All loads of one gear are solved in one analysis; the finite elements of the cup are solved once.

#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"

#include <fmt/format.h>

using namespace strainwave;

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: ex03_stiffness GEAR.toml\n");
    return 2;
  }
  try {
    Gear gear = load_gear(argv[1]).gear;
    gear.load.torque_nm.clear();
    for (int step = 1; step <= 12; ++step)
      gear.load.torque_nm.push_back(step); // N·m
    gear.load.rated_torque_nm = 7.0;
    ForwardModel model({.disk_cache = false});
    const ForwardResult result = model.analyze(gear);
    if (result.status != Status::ok) {
      fmt::print(stderr, "{}\n", result.message);
      return 3;
    }
    fmt::print("T [N·m]   θ [mrad]   tangent [N·m/rad]   teeth\n");
    for (const LoadResult& load : result.load)
      fmt::print("{:7.1f} {:10.4f} {:19.0f} {:7}\n", load.torque_nm, 1e3 * load.rotation_rad,
                 load.tangent_stiffness_nm_per_rad, load.engaged_count);
    fmt::print("secant stiffness: {:.0f} N·m/rad, lost motion {:.2f}'\n", result.stiffness->secant_nm_per_rad,
               result.stiffness->lost_motion_arcmin);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
