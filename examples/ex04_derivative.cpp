// Example 4: what does a micrometre of flank relief do?
//
// Responses of a gear as functions of two numbers of its file, with derivatives that are exact through the
// whole chain:
//
//     tip relief, profile shift x2 → flanks → gaps → contact → rotation, peak force, stiffness
//
// They are held against central differences of whole analyses, whose error is of fourth order in the step.
//
// Sample run:   ex04_derivative studies/gallery/seed.toml

#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/optimize/gear/gear_evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace strainwave;

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: ex04_derivative GEAR.toml\n");
    return 2;
  }
  try {
    const Gear gear = load_gear(argv[1]).gear;
    const DesignSpace design(
        {{.path = NumberPath("flank_modification.flexspline.tip_relief_um"),
          .lower = 0.0,
          .upper = 15.0,
          .start = 3.0},
         {.path = NumberPath("circular_spline.profile_shift"), .lower = 2.1, .upper = 2.3, .start = 2.2}});
    GearEvaluator evaluator(gear, design, {Load{.torque_nm = {7.0}}}, {.disk_cache = false});
    const std::vector<double> at = design.start();
    const std::vector<double> slopes = evaluator.gradient(at); // [response · variables + variable]
    double worst = 0.0;
    for (const char* name : {"rotation_rad", "peak_force_n", "min_backlash_um"}) {
      const std::size_t r = *find_response(evaluator.responses(), name);
      for (std::size_t i = 0; i < design.size(); ++i) {
        // Small enough that no tooth joins or leaves on the way; of fourth order, so that it need not be so
        // small that the rounding of two analyses shows.
        const double step = 1e-3 * (design.variables()[i].upper - design.variables()[i].lower);
        const auto at_steps = [&](double steps) {
          std::vector<double> moved = at;
          moved[i] += steps * step;
          return evaluator.evaluate(moved).values[r];
        };
        const double difference =
            (8.0 * (at_steps(1) - at_steps(-1)) - (at_steps(2) - at_steps(-2))) / (12.0 * step);
        const double exact = slopes[r * design.size() + i];
        worst = std::max(worst, std::abs(exact - difference) / std::max(std::abs(exact), 1e-12));
        fmt::print("∂ {:16} / ∂ variable {}: exact {:14.7g}, difference {:14.7g}\n", name, i, exact,
                   difference);
      }
    }
    fmt::print("largest relative difference {:.1e}\n", worst);
    fmt::print("exact and difference agree to 1e-6: {}\n", worst < 1e-6 ? "yes" : "no");
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
