// Studies without a model: what the engine, the journal and the designs cost per row.
#include "strainwave/common/rows/merge.hpp"
#include "strainwave/common/rows/run_rows.hpp"
#include "strainwave/common/sampling/design.hpp"
#include "strainwave/common/sampling/sources.hpp"

#include <benchmark/benchmark.h>
#include <filesystem>
#include <unistd.h>

namespace {

using namespace strainwave;

struct EmptyModel : RowModel {
  std::size_t inputs() const override { return 8; }
  std::size_t outputs() const override { return 4; }
  std::string_view status_name(std::uint8_t) const override { return "ok"; }
  std::unique_ptr<RowWorker> worker() const override {
    struct Worker : RowWorker {
      void evaluate(RowSlice& slice) override {
        for (std::size_t i = 0; i < slice.rows; ++i)
          for (std::size_t j = 0; j < 4; ++j)
            slice.outputs[4 * i + j] = slice.inputs[8 * i + j];
      }
    };
    return std::make_unique<Worker>();
  }
};

constexpr std::uint64_t million = 1 << 20;

EnginePlan plan() {
  return {.rows = million,
          .block_rows = 1024,
          .shard = 0,
          .shards = 1,
          .plan_hash = 1,
          .model_hash = 2,
          .origin = "bench"};
}

std::filesystem::path journal_file() {
  return std::filesystem::temp_directory_path() / ("strainwave-bench-" + std::to_string(::getpid()));
}

void per_row(benchmark::State& state, std::uint64_t rows) {
  state.counters["s/row"] = benchmark::Counter(
      static_cast<double>(rows), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Issue: at most 1 µs per evaluation, journal on, empty model; eight random inputs are drawn for each.
void EmptyStudy(benchmark::State& state) {
  const SampleDesign design({.design = SamplingDesign::random, .samples = million, .dimensions = 8});
  const RowInputs inputs = [&](std::uint64_t first, std::size_t count, std::span<double> rows) {
    design.points(first, count, rows);
  };
  for (auto _ : state) {
    std::filesystem::remove(journal_file());
    run_rows(plan(), inputs, EmptyModel{}, journal_file(), {.threads = static_cast<int>(state.range(0))});
  }
  std::filesystem::remove(journal_file());
  per_row(state, million);
}
BENCHMARK(EmptyStudy)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

// Issue: resume of 10^6 rows in less than 2 s.
void ResumeOfAMillionRows(benchmark::State& state) {
  EnginePlan rows = plan();
  rows.block_rows = static_cast<std::uint32_t>(state.range(0));
  const RowInputs inputs = [](std::uint64_t, std::size_t, std::span<double>) {};
  std::filesystem::remove(journal_file());
  run_rows(rows, inputs, EmptyModel{}, journal_file(), {});
  for (auto _ : state)
    run_rows(rows, inputs, EmptyModel{}, journal_file(), {});
  std::filesystem::remove(journal_file());
  per_row(state, million);
}
BENCHMARK(ResumeOfAMillionRows)->Arg(1)->Arg(1024)->Unit(benchmark::kMillisecond)->UseRealTime();

// 290 numbers: an error for every tooth of the seed gear's two members and a few of the whole gear.
void Design290(benchmark::State& state) {
  const SampleDesign design(
      {.design = static_cast<SamplingDesign>(state.range(0)), .samples = million, .dimensions = 290});
  std::vector<double> rows(64 * 290);
  std::uint64_t first = 0;
  for (auto _ : state) {
    design.points(first, 64, rows);
    benchmark::DoNotOptimize(rows.data());
    first = (first + 64) % million;
  }
  per_row(state, 64);
}
BENCHMARK(Design290)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMicrosecond);

void Normal290(benchmark::State& state) {
  const std::vector<Distribution> distributions(290, Normal{0.0, 0.5});
  const SourceValues sources(distributions);
  const SampleDesign design({.design = SamplingDesign::random, .samples = million, .dimensions = 290});
  std::vector<double> uniforms(64 * 290), rows;
  design.points(0, 64, uniforms);
  for (auto _ : state) {
    rows = uniforms;
    for (std::size_t i = 0; i < 64; ++i)
      sources.transform(std::span(rows).subspan(290 * i, 290));
    benchmark::DoNotOptimize(rows.data());
  }
  per_row(state, 64);
}
BENCHMARK(Normal290)->Unit(benchmark::kMicrosecond);

} // namespace
