// Unit responses of the seed cup on its default mesh: 20160 elements and 141120 nodes in the ring, all
// functionals (flank 5 heights × 2 directions, wall 2 stations × 7 rows × 2, sections 7 rows × 4). Goal: 1.5
// s and 1.5 GB on two cores.
//
// The peer: CalculiX on the same mesh, one load at a time. STRAINWAVE_BENCH_CCX=1 adds it (minutes).

#include "strainwave/model/flexspline/calculix.hpp"
#include "strainwave/model/flexspline/condensation.hpp"
#include "strainwave/model/flexspline/cyclic.hpp"
#include "strainwave/model/flexspline/response_store.hpp"
#include "strainwave/model/flexspline/responses.hpp"
#include "tests/support/calculix_output.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <Eigen/Core>
#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>

namespace {

using namespace strainwave;

ResponseRequest seed_request() {
  const Gear seed = seed_gear();
  ResponseRequest request;
  request.flexspline = seed.flexspline;
  request.material = seed.material;
  request.mesh = seed.mesh;
  return request;
}

void count_size(benchmark::State& state, const ResponseRequest& request) {
  const SectorMesh mesh =
      sector_mesh(request.flexspline, request.mesh, {request.teeth, request.sectors}).value();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["ring_nodes"] = static_cast<double>(mesh.ring_nodes());
  state.counters["functionals"] = response_functionals(request, mesh).layout.count();
  state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void unit_responses_of_the_seed_cup(benchmark::State& state) {
  ResponseRequest request = seed_request();
  request.estimate = state.range(1) != 0;
  request.sections = state.range(2) != 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(unit_responses(request, static_cast<int>(state.range(0))));
  count_size(state, request);
}
BENCHMARK(unit_responses_of_the_seed_cup)
    ->ArgNames({"threads", "estimate", "sections"})
    ->Args({2, 0, 1})
    ->Args({2, 1, 1})
    ->Args({1, 0, 1})
    ->Args({2, 0, 0})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void unit_responses_of_a_finer_cup(benchmark::State& state) {
  ResponseRequest request = seed_request();
  request.estimate = false;
  const Mesh& m = request.mesh;
  const int times = 2;
  request.wall_z_mm = {21.5, 22.5, 23.5, 24.5, 25.5, 26.5, 27.5};
  request.mesh = {times * m.per_pitch, times * m.along_face,   times * m.along_wall,
                  times * m.diaphragm, times * m.tooth_height, times * m.through_thickness};
  for (auto _ : state)
    benchmark::DoNotOptimize(unit_responses(request));
  count_size(state, request);
}
BENCHMARK(unit_responses_of_a_finer_cup)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void sector_condensation(benchmark::State& state) {
  const ResponseRequest request = seed_request();
  const SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
  const ResponseFunctionals plan = response_functionals(request, mesh);
  std::vector<const SectorWeights*> loads;
  for (const Functional& functional : plan.functionals)
    loads.push_back(&functional.here);
  for (auto _ : state)
    benchmark::DoNotOptimize(CondensedSector(mesh, request.material, loads).stiffness.data());
}
BENCHMARK(sector_condensation)->Unit(benchmark::kMillisecond);

void mesh_and_functionals(benchmark::State& state) {
  const ResponseRequest request = seed_request();
  for (auto _ : state) {
    const SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
    benchmark::DoNotOptimize(response_functionals(request, mesh));
  }
}
BENCHMARK(mesh_and_functionals)->Unit(benchmark::kMillisecond);

void responses_from_disk(benchmark::State& state) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("strainwave-bench-" + std::to_string(getpid()));
  const ResponseStore store(folder);
  const ResponseRequest request = seed_request();
  (void)stored_unit_responses(request, store);
  for (auto _ : state)
    benchmark::DoNotOptimize(store.find(request));
  state.counters["file_MB"] = static_cast<double>(std::filesystem::file_size(store.file(request))) / 1e6;
  std::filesystem::remove_all(folder);
}
BENCHMARK(responses_from_disk)->Unit(benchmark::kMillisecond);

void calculix_one_load(benchmark::State& state) {
  if (std::getenv("STRAINWAVE_BENCH_CCX") == nullptr) {
    state.SkipWithError("set STRAINWAVE_BENCH_CCX=1 to run CalculiX too");
    return;
  }
  ResponseRequest request = seed_request();
  request.estimate = false;
  const UnitResponses ours = unit_responses(request).value();
  const SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
  const ResponseFunctionals plan = response_functionals(request, mesh);
  const RingPart ring(mesh);
  const int load = ours.flank(2, 0, UnitResponses::circumferential);
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("strainwave-ccx-bench-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  {
    std::ofstream deck(folder / "cup.inp");
    write_calculix_deck(deck, ring, request.material,
                        {{{plan.functionals[static_cast<std::size_t>(load)], 0, 1.0}}}, "seed cup");
  }
  const std::string command = "cd '" + folder.string() + "' && OMP_NUM_THREADS=2 ccx cup > ccx.log 2>&1";
  for (auto _ : state)
    if (std::system(command.c_str()) != 0)
      state.SkipWithError("ccx failed");
  std::ifstream printed(folder / "cup.dat");
  const auto steps = testing_support::read_calculix_displacements(printed, ring.nodes());
  if (steps.size() != 1) {
    state.SkipWithError("ccx printed no displacements");
    return;
  }
  const std::vector<double> angles = ring.angles();
  Eigen::VectorXd u(3 * ring.nodes());
  for (std::size_t n = 0; n < angles.size(); ++n) {
    const double c = std::cos(angles[n]), s = std::sin(angles[n]), x = steps[0][3 * n],
                 y = steps[0][3 * n + 1];
    u.segment<3>(static_cast<Eigen::Index>(3 * n)) << c * x + s * y, c * y - s * x, steps[0][3 * n + 2];
  }
  double worst = 0.0, scale = 0.0;
  for (int k = 0; k < ours.sectors; ++k)
    for (int a = 0; a < ours.flank_count() + ours.wall_count(); ++a) {
      worst = std::max(worst, std::fabs(ours(k, a, load) -
                                        ring.measure(plan.functionals[static_cast<std::size_t>(a)], k, u)));
      scale = std::max(scale, std::fabs(ours(k, a, load)));
    }
  state.counters["relative_difference"] = worst / scale;
  std::filesystem::remove_all(folder);
}
BENCHMARK(calculix_one_load)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();

} // namespace
