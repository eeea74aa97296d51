// What one tolerance sample costs before any contact is solved: errors of all teeth, both lobes, seed gear.
#include "studies/sampling/design.hpp"
#include "studies/sampling/sources.hpp"
#include "studies/tolerance/tolerance_model.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace strainwave;

ToleranceModel seed_model() {
  const Gear gear = seed_gear();
  const NeutralCurve curve = NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
  return ToleranceModel::make(gear, curve,
                              {{.kind = ToleranceKind::adjacent_pitch},
                               {.kind = ToleranceKind::adjacent_pitch, .member = Member::circular_spline},
                               {.kind = ToleranceKind::cumulative_pitch},
                               {.kind = ToleranceKind::run_out},
                               {.kind = ToleranceKind::tooth_thickness},
                               {.kind = ToleranceKind::centre_offset}})
      .value();
}

void Prepare(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(seed_model());
}
BENCHMARK(Prepare)->Unit(benchmark::kMicrosecond);

void BacklashOfOneSample(benchmark::State& state) {
  const ToleranceModel model = seed_model();
  const std::vector<double> values(model.dimensions(), 0.001);
  std::vector<double> backlash(model.teeth()), radius(model.teeth());
  int position = 0;
  for (auto _ : state) {
    model.backlash(values, position++ % 140, backlash, radius);
    benchmark::DoNotOptimize(backlash.data());
  }
}
BENCHMARK(BacklashOfOneSample)->Unit(benchmark::kMicrosecond);

void DrawAndTransformOneSample(benchmark::State& state) {
  const ToleranceModel model = seed_model();
  const int n = static_cast<int>(model.dimensions());
  const std::vector<Distribution> distributions(model.dimensions(), Normal{0.0, 0.001});
  const SourceValues sources(distributions);
  const SampleDesign design(
      {.design = static_cast<SamplingDesign>(state.range(0)), .samples = 1 << 20, .dimensions = n});
  std::vector<double> values(model.dimensions());
  std::uint64_t k = 0;
  for (auto _ : state) {
    design.points(k++ % (1 << 20), 1, values);
    sources.transform(values);
    benchmark::DoNotOptimize(values.data());
  }
}
BENCHMARK(DrawAndTransformOneSample)->Arg(0)->Arg(2)->Unit(benchmark::kMicrosecond);

} // namespace
