// Tolerance samples of the seed gear, both lobes with errors of every tooth: what is spent before any contact
// is solved, and whole rows through contact and outputs. s_per_million: wall-clock seconds of 10⁶ rows on the
// threads of the line; cpu_us_per_row: of one thread, whatever else the machine does.
#include "strainwave/common/sampling/design.hpp"
#include "strainwave/common/sampling/sources.hpp"
#include "strainwave/model/tolerance/tolerance_model.hpp"
#include "strainwave/studies/tolerances/monte_carlo.hpp"
#include "strainwave/studies/tolerances/sampled_gear.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>
#include <mutex>
#include <sys/resource.h>

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

/// The gallery's sources without the discs, or with u0 and e.
StudyFile gallery(Fidelity fidelity, bool discs) {
  const auto error = [](std::string name, SourceKind kind, Distribution d, SourceMember member,
                        std::string path) {
    return StudySource{
        .name = std::move(name), .kind = kind, .member = member, .path = std::move(path), .distribution = d};
  };
  StudyFile study(monte_carlo_kind());
  auto& part = study.part<MonteCarloPart>();
  study.gear = seed_gear();
  study.gear.contact.fidelity = fidelity;
  study.load_cases = {{.torque_nm = 7.0, .rotation_rad = {}}};
  constexpr auto flexspline = SourceMember::flexspline, spline = SourceMember::circular_spline;
  part.sources = {
      error("fs", SourceKind::adjacent_pitch, Normal{0.0, 0.43}, flexspline, ""),
      error("cs", SourceKind::adjacent_pitch, Normal{0.0, 0.43}, spline, ""),
      error("run-out", SourceKind::run_out, Lognormal{1.0, 0.5}, flexspline, ""),
      error("x2", SourceKind::gear_key, Normal{2.19, 0.005}, flexspline, "circular_spline.profile_shift")};
  if (discs) {
    part.sources.push_back(error("u0", SourceKind::gear_key, Normal{0.2, 0.0005}, flexspline,
                                 "wave_generator.max_radial_deformation_mm"));
    part.sources.push_back(
        error("e", SourceKind::gear_key, Normal{0.6, 0.002}, flexspline, "wave_generator.eccentricity_mm"));
  }
  part.sampling.design = SamplingDesign::random;
  part.sampling.samples = 1 << 20;
  return study;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Draw, errors, contact, outputs; 64 rows at a time.
void Rows(benchmark::State& state, Fidelity fidelity, bool discs) {
  static std::map<std::pair<Fidelity, bool>, SampledStudy> made;
  static std::mutex guard;
  const SampledStudy* study = nullptr;
  {
    const std::lock_guard lock(guard);
    auto found = made.find({fidelity, discs});
    if (found == made.end())
      found = made.emplace(std::pair{fidelity, discs},
                           make_monte_carlo_rows(gallery(fidelity, discs), {}).value())
                  .first;
    study = &found->second;
  }
  constexpr std::size_t rows = 64;
  const auto worker = study->model->worker();
  std::vector<double> inputs(rows * study->model->inputs()), outputs(rows * study->model->outputs());
  std::vector<std::uint8_t> status(rows);
  std::vector<RowMessage> messages;
  std::uint64_t first = static_cast<std::uint64_t>(state.thread_index()) << 18;
  std::uint64_t done = 0, failed = 0;
  const auto start = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  for (auto _ : state) {
    study->inputs(first % (1 << 19), rows, inputs);
    std::fill(status.begin(), status.end(), row_ok);
    RowSlice slice{.first = first,
                   .rows = rows,
                   .inputs = inputs,
                   .outputs = outputs,
                   .status = status,
                   .messages = &messages};
    worker->evaluate(slice);
    first += rows;
    done += rows;
    failed += static_cast<std::uint64_t>(rows) -
              static_cast<std::uint64_t>(std::count(status.begin(), status.end(), row_ok));
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  const double millions = 1e-6 * static_cast<double>(done);
  // threads run side by side: wall-clock of one over the rows of all
  state.counters["s_per_million"] =
      benchmark::Counter(wall.count() / (millions * state.threads()), benchmark::Counter::kAvgThreads);
  state.counters["cpu_us_per_row"] =
      benchmark::Counter((cpu_seconds() - cpu) / millions, benchmark::Counter::kAvgThreads);
  state.counters["failed"] = benchmark::Counter(static_cast<double>(failed));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["MB"] =
      benchmark::Counter(static_cast<double>(usage.ru_maxrss) / 1024.0, benchmark::Counter::kAvgThreads);
}
BENCHMARK_CAPTURE(Rows, linear, Fidelity::linear, false)
    ->Threads(1)
    ->Threads(2)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Rows, unilateral, Fidelity::unilateral, false)
    ->Threads(1)
    ->Threads(2)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Rows, unilateral_with_discs, Fidelity::unilateral, true)
    ->Threads(1)
    ->Threads(2)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

} // namespace
