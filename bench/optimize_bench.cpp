// Optimisation: one evaluation of the seed gear at a design that is new, and what the layer above the model
// costs. The cup comes from the cache on disk.

#include "strainwave/optimize/gear/force_bound.hpp"
#include "strainwave/optimize/gear/gear_evaluator.hpp"
#include "strainwave/optimize/problem/evaluation_store.hpp"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace strainwave {
namespace {

DesignSpace seed_design() {
  return DesignSpace({{.path = NumberPath("flank_modification.flexspline.root_relief_um"),
                       .lower = 0.0,
                       .upper = 15.0,
                       .start = 2.0,
                       .links = {}},
                      {.path = NumberPath("wave_generator.max_radial_deformation_mm"),
                       .lower = 0.19,
                       .upper = 0.21,
                       .start = 0.2,
                       .links = {{NumberPath("wave_generator.eccentricity_mm"), 3.0}}}});
}

/// range(0): phases; range(1): 0 flank alone, 1 u0 too, which assembles the cup anew.
void evaluate_new_design(benchmark::State& state) {
  const Load load{.torque_nm = {7.0}, .rotation_rad = {}, .phases = static_cast<int>(state.range(0))};
  GearEvaluator evaluator(seed_gear(), seed_design(), {load});
  (void)evaluator.evaluate(std::vector{1.0, 0.2});
  double step = 0.0;
  for (auto _ : state) {
    step += 1e-4;
    const Evaluation e =
        evaluator.evaluate(std::vector{2.0 + step, 0.2 - (state.range(1) ? 1e-3 * step : 0.0)});
    if (!e.ok)
      state.SkipWithError(e.message.c_str());
  }
}
BENCHMARK(evaluate_new_design)->ArgsProduct({{1, 4}, {0, 1}})->Unit(benchmark::kMillisecond);

/// Ten numbers of the flanks, and u0 with e in the second place of range(1).
DesignSpace flank_design(bool with_u0, bool lead) {
  const std::string fs = "flank_modification.flexspline.", cs = "flank_modification.circular_spline.";
  std::vector<DesignVariable> variables;
  const auto add = [&](const std::string& path, double upper, double start) {
    variables.push_back(
        {.path = NumberPath(path), .lower = 0.0, .upper = upper, .start = start, .links = {}});
  };
  add(fs + "tip_relief_um", 15.0, 2.0);
  add(fs + "tip_relief_start", 0.9, 0.55);
  add(fs + "root_relief_um", 15.0, 1.0);
  add(fs + "root_relief_start", 0.9, 0.35);
  add(fs + "crowning_um", 5.0, 0.5);
  add(fs + "slope_um", 5.0, 0.5);
  add(lead ? fs + "lead_taper_um" : cs + "tip_relief_start", lead ? 15.0 : 0.9, lead ? 2.0 : 0.55);
  add(lead ? fs + "lead_crowning_um" : cs + "crowning_um", 10.0, 1.0);
  add(cs + "tip_relief_um", 5.0, 0.5);
  add("circular_spline.profile_shift", 3.0, lead ? 2.3 : 2.19);
  if (with_u0) {
    variables.push_back({.path = NumberPath("wave_generator.max_radial_deformation_mm"),
                         .lower = 0.19,
                         .upper = 0.21,
                         .start = 0.2,
                         .links = {}});
    variables.push_back({.path = NumberPath("wave_generator.eccentricity_mm"),
                         .lower = 0.5,
                         .upper = 0.7,
                         .start = 0.6,
                         .links = {}});
  }
  return DesignSpace(std::move(variables));
}

/// range(0): 0 one point per tooth linear, 1 the same unilateral, 2 nine heights, 3 nine heights and five
/// slices of the coned cup; range(1): u0 and e free too; range(2): with its gradient. Four phases, every
/// evaluation a new design.
void evaluate_design(benchmark::State& state) {
  const auto model = state.range(0);
  const bool with_u0 = state.range(1) != 0;
  Gear gear = seed_gear();
  gear.contact.fidelity = model == 0 ? Fidelity::linear : Fidelity::unilateral;
  gear.contact.flank_points = model >= 2 ? 9 : 1;
  gear.contact.face_slices = model == 3 ? 5 : 1;
  gear.contact.gaps = model == 3 ? GapModel::assembled : GapModel::kinematic;
  const DesignSpace design = flank_design(with_u0, model == 3);
  const Load load{.torque_nm = {7.0}, .rotation_rad = {}, .phases = 4};
  GearEvaluator evaluator(gear, design, {load});
  std::vector<double> x = design.start();
  (void)evaluator.evaluate(x);
  for (auto _ : state) {
    x[0] += 1e-4;
    if (with_u0)
      x[10] -= 1e-7;
    const Evaluation e = evaluator.evaluate(x);
    if (!e.ok)
      state.SkipWithError(e.message.c_str());
    if (state.range(2))
      benchmark::DoNotOptimize(evaluator.gradient(x));
  }
}
BENCHMARK(evaluate_design)
    ->ArgNames({"model", "u0", "gradient"})
    ->ArgsProduct({{0, 1, 2, 3}, {0, 1}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

struct Nothing : Evaluator {
  std::span<const Response> responses() const override { return gear_responses(); }
  Evaluation evaluate(std::span<const double> x) override {
    Evaluation e;
    e.ok = true;
    e.values.assign(gear_responses().size(), x[0]);
    return e;
  }
};

void store_new_point(benchmark::State& state) {
  Nothing nothing;
  EvaluationStore store(nothing);
  double x = 0.0;
  for (auto _ : state)
    benchmark::DoNotOptimize(store.evaluate(std::vector{x += 1.0, 0.2}));
}
BENCHMARK(store_new_point);

void store_known_point(benchmark::State& state) {
  Nothing nothing;
  EvaluationStore store(nothing);
  for (auto _ : state)
    benchmark::DoNotOptimize(store.evaluate(std::vector{1.0, 0.2}));
}
BENCHMARK(store_known_point);

/// All contiguous sets of n teeth with a compliance that falls off with distance.
void force_bound(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  std::vector<std::vector<double>> compliance(n, std::vector<double>(n));
  std::vector<double> clearance(n), radius(n, 14.5);
  for (std::size_t i = 0; i < n; ++i) {
    const double middle = static_cast<double>(i) - 0.5 * static_cast<double>(n);
    clearance[i] = 4.0 + 0.1 * middle * middle;
    for (std::size_t j = 0; j < n; ++j)
      compliance[i][j] = 0.05 + (i == j ? 0.1 : 0.05 / static_cast<double>(1 + (i > j ? i - j : j - i)));
  }
  for (auto _ : state)
    benchmark::DoNotOptimize(least_peak_force(compliance, clearance, radius, 7.0, 2.5e-3));
}
BENCHMARK(force_bound)->Arg(28)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace strainwave
