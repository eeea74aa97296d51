// Example 1: how far is every tooth from touching?
//
//     circular spline  ___     ___     ___      the wave generator bends the cup into an oval; each of its
//     teeth then
//                         \___/ · \___/         stands in a space of the rigid ring with a gap on either
//                         flank: the
//     flexspline           /‾\ ‾ ‾ /‾\          initial backlash. Below 0 it would interfere.
//
// Sample run:   ex01_backlash studies/gallery/seed.toml
//
// A gear file is read, the forward model asked for the backlash alone: the finite elements are skipped.

#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

using namespace strainwave;

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: ex01_backlash GEAR.toml\n");
    return 2;
  }
  try {
    const Gear gear = load_gear(argv[1]).gear; // throws FileError: all faults, with line, column and key
    ForwardModel model;
    const ForwardResult result = model.analyze(gear, Want::backlash);
    if (result.status != Status::ok || !result.backlash) { // a gear that cannot be computed is no exception
      fmt::print(stderr, "{}\n", result.message);
      return 3;
    }
    const BacklashResult& backlash = *result.backlash;
    fmt::print("tooth    φ [°]   drive [µm]   coast [µm]\n");
    for (std::size_t i = 0; i < backlash.tooth.size(); ++i)
      if (std::abs(backlash.phi_deg[i]) < 15.0)
        fmt::print("{:5} {:8.2f} {:12.2f} {:12.2f}\n", backlash.tooth[i], backlash.phi_deg[i],
                   backlash.backlash_um[i], backlash.coast_backlash_um[i]);
    // Between the teeth too: over one turn every place of the oval sees a tooth.
    fmt::print("least backlash: {:.2f} µm at φ = {:.2f}°\n", backlash.min_um, backlash.min_phi_deg);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
