// Contact solver: direct solves cold and warm, at a rotation and at a torque, and the whole event path.
// "Cold": no closed set is known, M, q, r are in memory. Use --benchmark_repetitions and read the minimum.

#include "strainwave/model/lcp/march.hpp"
#include "strainwave/model/lcp/path.hpp"
#include "tests/model/lcp/problems.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>

namespace strainwave {
namespace {

using namespace contact_problems;

const std::string folder =
    (std::filesystem::path(__FILE__).parent_path().parent_path() / "tests" / "reference").string();

/// One problem and the rotation at which the seed gear carries about 7 N·m (both lobes).
struct Case {
  ContactProblem problem;
  double rotation = 0.0, torque = 0.0; ///< rad, N·mm of one lobe
  ActiveSet closed;
  ContactSolver solver;

  void load_with(double torque_nmm) {
    const ContactState state = solver.solve_torque(problem, torque_nmm).value();
    rotation = state.rotation;
    torque = torque_nmm;
    closed = state.active;
  }
};

Case make(const std::string& name) {
  Case c;
  if (name == "linear_28") {
    c.problem = load_path(read_json(folder + "/load-path.json"));
    c.load_with(3500.0);
  } else if (name == "linear_140") {
    c.problem = smooth(140);
    c.load_with(c.solver.solve_at(c.problem, 4e-3).torque);
  } else {
    const int lobes = name == "unilateral_two_lobes" ? 2 : 1;
    c.problem = seed_on_discs(read_json(folder + "/load-path.json"),
                              read_json(folder + "/unit-responses.json"), c.solver, lobes);
    c.load_with(lobes * 3500.0);
  }
  return c;
}

void report(benchmark::State& state, const Case& c, const ContactState& result) {
  state.counters["closed"] = static_cast<double>(std::count(result.active.begin(), result.active.end(), 1));
  state.counters["solves"] = result.iterations;
  state.counters["n"] = c.problem.size();
}

void direct(benchmark::State& state, const std::string& name, bool warm) {
  Case c = make(name);
  ContactState result;
  const ActiveSet guess = warm ? c.closed : ActiveSet{};
  for (auto _ : state) {
    c.solver.solve_at(c.problem, c.rotation, guess, {}, result);
    benchmark::DoNotOptimize(result.torque);
  }
  report(state, c, result);
}

void at_torque(benchmark::State& state, const std::string& name, bool warm) {
  Case c = make(name);
  const ActiveSet guess = warm ? c.closed : ActiveSet{};
  ContactState result;
  for (auto _ : state) {
    result = c.solver.solve_torque(c.problem, c.torque, guess).value();
    benchmark::DoNotOptimize(result.torque);
  }
  report(state, c, result);
}

void path(benchmark::State& state, const std::string& name, PathRange range) {
  Case c = make(name);
  EventPath result;
  for (auto _ : state) {
    c.solver.trace(c.problem, range, {}, result);
    benchmark::DoNotOptimize(result.linear_solves());
  }
  state.counters["events"] = static_cast<double>(result.events().size());
  state.counters["N_m"] = 2e-3 * result.end_torque();
}

/// The source text's marching to the same torque; its error is the worst of the torque at the events of the
/// exact path.
void marching(benchmark::State& state, const std::string& name, double torque_nmm, double step,
              double least_step) {
  Case c = make(name);
  const EventPath exact = c.solver.trace(c.problem, {.end_torque = torque_nmm});
  March result;
  for (auto _ : state) {
    result = march(c.problem, 0.0, exact.end_rotation(), {.step = step, .least_step = least_step}, c.solver);
    benchmark::DoNotOptimize(result.tried);
  }
  double worst = 0.0;
  for (const PathEvent& event : exact.events())
    worst = std::max(worst, std::abs(result.torque_at(event.rotation) - event.torque));
  state.counters["steps"] = result.tried;
  state.counters["error_N_mm"] = worst;
}

BENCHMARK_CAPTURE(direct, linear_28_cold, "linear_28", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(direct, linear_28_warm, "linear_28", true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(direct, linear_140_cold, "linear_140", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(direct, linear_140_warm, "linear_140", true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(direct, unilateral_448_cold, "unilateral", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(direct, unilateral_448_warm, "unilateral", true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(at_torque, linear_28_cold, "linear_28", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(at_torque, linear_28_warm, "linear_28", true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(at_torque, linear_140_cold, "linear_140", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(at_torque, linear_140_warm, "linear_140", true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(at_torque, unilateral_448_cold, "unilateral", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(at_torque, unilateral_448_warm, "unilateral", true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(path, linear_28_to_7_Nm, "linear_28", PathRange{.end_torque = 3500.0})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(path, linear_28_all_events, "linear_28", PathRange{})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(path, linear_140_to_8_mrad, "linear_140", PathRange{.end_rotation = 8e-3})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(path, unilateral_448_to_12_Nm, "unilateral", PathRange{.end_torque = 6000.0})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(path, unilateral_896_both_lobes_to_12_Nm, "unilateral_two_lobes",
                  PathRange{.end_torque = 12000.0})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(marching, linear_28_to_7_Nm_coarse, "linear_28", 3500.0, 1e-4, 1e-6)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(marching, linear_28_to_7_Nm_fine, "linear_28", 3500.0, 1e-5, 1e-9)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(marching, unilateral_448_to_12_Nm_coarse, "unilateral", 6000.0, 1e-4, 1e-6)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(marching, unilateral_448_to_12_Nm_fine, "unilateral", 6000.0, 1e-5, 1e-9)
    ->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace strainwave
