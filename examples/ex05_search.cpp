// Example 5: a better flank.
//
//     minimise    largest meshing force at 7 N·m, the worst of four meshing phases
//     over        tip relief and root relief of the flexspline, 0 … 15 µm
//     subject to  secant stiffness ≥ 95 % of what it was,  least backlash ≥ 0
//
// The default plan surveys the box, polishes what looks good, and judges the best with a fresh evaluator that
// shares nothing with the search (studies/gallery/seed_relief_only.toml says the same as a file).
//
// Sample run:   ex05_search studies/gallery/seed.toml

#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/optimize/gear/gear_evaluator.hpp"
#include "strainwave/optimize/plans/optimise.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

using namespace strainwave;

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: ex05_search GEAR.toml\n");
    return 2;
  }
  try {
    const Gear gear = load_gear(argv[1]).gear;
    const auto relief = [](const char* where) {
      return DesignVariable{.path = NumberPath(std::string("flank_modification.flexspline.") + where),
                            .lower = 0.0,
                            .upper = 15.0,
                            .start = 2.0};
    };
    const DesignSpace design({relief("tip_relief_um"), relief("root_relief_um")});
    const std::vector<Load> loads = {Load{.torque_nm = {7.0}, .phases = 4}};
    GearEvaluator evaluator(gear, design, loads), fresh(gear, design, loads);
    const Evaluation unmodified = evaluator.evaluate_base();
    if (!unmodified.ok) {
      fmt::print(stderr, "{}\n", unmodified.message);
      return 3;
    }
    const std::array<Constraint, 2> limits{
        Constraint{.output = "secant_nm_per_rad", .min_ratio_to_baseline = 0.95},
        Constraint{.output = "min_backlash_um", .min = 0.0}};
    const Problem problem(design, evaluator, {.output = "peak_force_n"}, limits, unmodified);
    Monitor monitor(400);
    const OptimiseResult result = optimise(
        problem,
        {.search = {.method = std::string(global_method), .budget = 400, .tolerance = 1e-3}, .starts = 2},
        fresh, monitor);
    const Judgement& judgement = result.judgement;
    fmt::print("{} after {} points: {}\n", verdict_name(judgement.verdict), result.found.asked,
               judgement.message);
    if (!judgement.best || !judgement.fresh)
      return 3;
    const std::vector<double> x = design.unscaled(judgement.best->y);
    fmt::print("tip relief {:.2f} µm, root relief {:.2f} µm\n", x[0], x[1]);
    const std::size_t peak = problem.objective_response();
    fmt::print("largest meshing force: {:.2f} → {:.2f} N\n", unmodified.values[peak],
               judgement.fresh->values[peak]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
