// Displacement fields of the whole cup under assembly-like loads: sector by sector, and by factorizing
// the whole ring.

#include "strainwave/model/flexspline/cyclic_field.hpp"
#include "strainwave/model/flexspline/cyclic_stress.hpp"
#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/model/flexspline/ring.hpp"
#include "tests/model/flexspline/ring_solver.hpp"

#include <benchmark/benchmark.h>

namespace strainwave {
namespace {

/// The seed cup on its default mesh: 141 120 nodes; four states of some hundred forces each.
struct SeedCup {
  Gear gear = seed_gear();
  SectorMesh mesh = sector_mesh(gear.flexspline, gear.mesh).value();
  std::vector<Functional> functionals;
  std::vector<std::vector<FieldLoad>> cases{4};
  SeedCup() {
    ResponseRequest request;
    request.flexspline = gear.flexspline;
    request.material = gear.material;
    request.mesh = gear.mesh;
    const ResponseFunctionals plan = response_functionals(request, mesh);
    functionals = plan.functionals;
    for (std::size_t c = 0; c < cases.size(); ++c)
      for (int sector = 0; sector < mesh.sectors; ++sector)
        cases[c].push_back({&functionals[static_cast<std::size_t>(plan.layout.wall(
                                static_cast<int>(c % 2), static_cast<int>(c), UnitResponses::radial))],
                            sector, sector % 70 < 20 ? 1.0 : 0.0});
  }
};

void field_by_sectors(benchmark::State& state) {
  const SeedCup cup;
  for (auto _ : state)
    benchmark::DoNotOptimize(ring_field(cup.mesh, cup.gear.material, cup.cases));
}
BENCHMARK(field_by_sectors)->Unit(benchmark::kMillisecond);

void field_by_whole_ring(benchmark::State& state) {
  const SeedCup cup;
  for (auto _ : state) {
    const RingPart ring(cup.mesh);
    Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * ring.nodes(), 4);
    for (std::size_t c = 0; c < 4; ++c)
      for (const FieldLoad& load : cup.cases[c])
        ring.add_load(*load.functional, load.sector, load.factor, force.col(static_cast<Eigen::Index>(c)));
    benchmark::DoNotOptimize(testing_support::RingSolver(ring, cup.gear.material).solve(force));
  }
}
BENCHMARK(field_by_whole_ring)->Unit(benchmark::kMillisecond)->Iterations(1);

void stress(benchmark::State& state) {
  const SeedCup cup;
  const RingField field = ring_field(cup.mesh, cup.gear.material, cup.cases);
  for (auto _ : state)
    benchmark::DoNotOptimize(largest_von_mises(cup.mesh, cup.gear.material, field.displacement));
}
BENCHMARK(stress)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace strainwave
