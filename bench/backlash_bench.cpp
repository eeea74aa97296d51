// Kinematics and initial backlash of the seed gear, drive and coast flank, one meshing phase. "Cold" starts
// at the gear's numbers: wave-generator curve (elastica included), checks, flanks, every tooth.
//   window: the 28 teeth of -21 to 51 degrees;  all: the 70 teeth of one lobe.

#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/tooth/backlash.hpp"
#include "strainwave/model/tooth/backlash_gradient.hpp"
#include "strainwave/model/tooth/consistency.hpp"

#include <benchmark/benchmark.h>

using namespace strainwave;

namespace {

enum Teeth { window, all };
enum Flanks { plain, relieved };

Gear gear_of(WaveGeneratorShape shape, int teeth, int flanks = plain) {
  Gear gear = seed_gear();
  gear.wave_generator.shape = shape;
  if (teeth == window)
    gear.contact.window_deg = {-21.0, 51.43};
  if (flanks == relieved) {
    gear.flank_modification.flexspline.tip_relief_um = 5.0;
    gear.flank_modification.flexspline.spline_um = {1.0, 0.5, 1.0, 3.0};
    gear.flank_modification.circular_spline.tip_relief_um = 3.0;
  }
  return gear;
}

NeutralCurve curve_of(const Gear& gear) {
  return NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
}

const std::vector<std::string> ten_parameters{"wave_generator.max_radial_deformation_mm",
                                              "wave_generator.eccentricity_mm",
                                              "flexspline.profile_shift",
                                              "circular_spline.profile_shift",
                                              "flexspline.tip_radius_mm",
                                              "circular_spline.tip_radius_mm",
                                              "flank_modification.flexspline.tip_relief_um",
                                              "flank_modification.flexspline.tip_relief_start",
                                              "flank_modification.flexspline.crowning_um",
                                              "flank_modification.circular_spline.slope_um"};

void curve(benchmark::State& state, WaveGeneratorShape shape) {
  const Gear gear = gear_of(shape, all);
  for (auto _ : state)
    benchmark::DoNotOptimize(NeutralCurve::make(gear.wave_generator, gear.flexspline));
}

void pose(benchmark::State& state, WaveGeneratorShape shape) {
  const NeutralCurve line = curve_of(gear_of(shape, all));
  double phi = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(line.pose(phi));
    phi = phi < 1.5 ? phi + 0.01 : 0.0;
  }
}

void backlash_cold(benchmark::State& state, WaveGeneratorShape shape, int teeth, int flanks) {
  const Gear gear = gear_of(shape, teeth, flanks);
  for (auto _ : state) {
    const NeutralCurve line = curve_of(gear);
    benchmark::DoNotOptimize(backlash(gear, line));
  }
}

void backlash_on_curve(benchmark::State& state, WaveGeneratorShape shape, int teeth, int flanks) {
  const Gear gear = gear_of(shape, teeth, flanks);
  const NeutralCurve line = curve_of(gear);
  for (auto _ : state)
    benchmark::DoNotOptimize(backlash(gear, line));
}

/// The derivatives beside a value that is already there.
void gradient_of_ten(benchmark::State& state, WaveGeneratorShape shape, int teeth, int flanks) {
  const Gear gear = gear_of(shape, teeth, flanks);
  const NeutralCurve line = curve_of(gear);
  const Backlash value = backlash(gear, line).value();
  for (auto _ : state)
    benchmark::DoNotOptimize(backlash_gradient(gear, line, value, ten_parameters));
}

void least(benchmark::State& state, WaveGeneratorShape shape) {
  const Gear gear = gear_of(shape, all);
  const NeutralCurve line = curve_of(gear);
  for (auto _ : state)
    benchmark::DoNotOptimize(least_backlash(gear, line));
}

void contradiction(benchmark::State& state, int flanks) {
  const Gear gear = gear_of(WaveGeneratorShape::two_disc, all, flanks);
  for (auto _ : state)
    benchmark::DoNotOptimize(find_contradiction(gear));
}

constexpr auto first = WaveGeneratorShape::two_disc;
constexpr auto exact = WaveGeneratorShape::two_disc_exact;

} // namespace

BENCHMARK_CAPTURE(curve, first_order, first);
BENCHMARK_CAPTURE(curve, exact, exact);
BENCHMARK_CAPTURE(pose, first_order, first);
BENCHMARK_CAPTURE(pose, exact, exact);
BENCHMARK_CAPTURE(backlash_cold, first_order_window, first, window, plain);
BENCHMARK_CAPTURE(backlash_cold, first_order_all, first, all, plain);
BENCHMARK_CAPTURE(backlash_cold, exact_window, exact, window, plain);
BENCHMARK_CAPTURE(backlash_cold, exact_all, exact, all, plain);
BENCHMARK_CAPTURE(backlash_on_curve, first_order_window, first, window, plain);
BENCHMARK_CAPTURE(gradient_of_ten, first_order_window, first, window, plain);
BENCHMARK_CAPTURE(backlash_on_curve, first_order_all, first, all, plain);
BENCHMARK_CAPTURE(gradient_of_ten, first_order_all, first, all, plain);
BENCHMARK_CAPTURE(backlash_on_curve, exact_all, exact, all, plain);
BENCHMARK_CAPTURE(gradient_of_ten, exact_all, exact, all, plain);
BENCHMARK_CAPTURE(backlash_cold, first_order_window_relieved, first, window, relieved);
BENCHMARK_CAPTURE(backlash_on_curve, first_order_window_relieved, first, window, relieved);
BENCHMARK_CAPTURE(gradient_of_ten, first_order_window_relieved, first, window, relieved);
BENCHMARK_CAPTURE(least, first_order, first);
BENCHMARK_CAPTURE(least, exact, exact);
BENCHMARK_CAPTURE(contradiction, plain, plain);
BENCHMARK_CAPTURE(contradiction, relieved, relieved);
