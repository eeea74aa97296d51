// The forward model on the seed gear, finite elements already solved: what one evaluation of a study costs.

#include "model/forward/forward.hpp"

#include <benchmark/benchmark.h>

namespace strainwave {
namespace {

ForwardModel& warm_model() {
  static ForwardModel* model = [] {
    auto* made = new ForwardModel({.disk_cache = false});
    (void)made->analyze(seed_gear());
    return made;
  }();
  return *model;
}

Gear one_load(double torque_nm) {
  Gear gear = seed_gear();
  gear.contact.window_deg = {-21.0, 51.0};
  gear.load.torque_nm = {torque_nm};
  gear.load.rated_torque_nm = 0.0; // no stiffness: one load alone
  return gear;
}

void everything_known(benchmark::State& state) {
  Gear gear = one_load(7.0);
  (void)warm_model().analyze(gear); // finite elements and whatever else does not change
  for (auto _ : state)
    benchmark::DoNotOptimize(warm_model().analyze(gear));
}
BENCHMARK(everything_known)->Unit(benchmark::kMillisecond);

// A flank changes: backlash and load are new, the assembled cup is reused.
void new_flank(benchmark::State& state) {
  Gear gear = one_load(7.0);
  (void)warm_model().analyze(gear); // finite elements and whatever else does not change
  double relief = 0.0;
  for (auto _ : state) {
    gear.flank_modification.flexspline.tip_relief_um = relief += 1e-3;
    benchmark::DoNotOptimize(warm_model().analyze(gear));
  }
}
BENCHMARK(new_flank)->Unit(benchmark::kMillisecond);

// The wave generator changes: kinematics, assembly, backlash and load are new; the finite elements are not.
void new_deformation(benchmark::State& state) {
  Gear gear = one_load(7.0);
  (void)warm_model().analyze(gear); // finite elements and whatever else does not change
  for (auto _ : state) {
    gear.wave_generator.max_radial_deformation_mm -= 1e-7;
    benchmark::DoNotOptimize(warm_model().analyze(gear));
  }
}
BENCHMARK(new_deformation)->Unit(benchmark::kMillisecond);

// The same with fidelity linear.
void new_deformation_linear(benchmark::State& state) {
  Gear gear = one_load(7.0);
  gear.contact.fidelity = Fidelity::linear;
  (void)warm_model().analyze(gear); // finite elements and whatever else does not change
  for (auto _ : state) {
    gear.wave_generator.max_radial_deformation_mm -= 1e-7;
    benchmark::DoNotOptimize(warm_model().analyze(gear));
  }
}
BENCHMARK(new_deformation_linear)->Unit(benchmark::kMillisecond);

// 28 teeth × 6 heights × 5 slices: gaps, selection and contact solve are new; assembly and finite elements are not.
void whole_flank(benchmark::State& state) {
  Gear gear = one_load(7.0);
  gear.contact.flank_points = 6;
  gear.contact.face_slices = 5;
  (void)warm_model().analyze(gear); // finite elements and whatever else does not change
  double relief = 0.0;
  for (auto _ : state) {
    gear.flank_modification.flexspline.tip_relief_um = relief += 1e-3;
    benchmark::DoNotOptimize(warm_model().analyze(gear));
  }
}
BENCHMARK(whole_flank)->Unit(benchmark::kMillisecond);

void backlash_only(benchmark::State& state) {
  Gear gear = one_load(7.0);
  (void)warm_model().analyze(gear); // finite elements and whatever else does not change
  for (auto _ : state)
    benchmark::DoNotOptimize(warm_model().analyze(gear, Want::backlash));
}
BENCHMARK(backlash_only)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace strainwave
