// The forward model on the seed gear, finite elements already solved: what one evaluation of a study costs.

#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/loading/load_cases.hpp"
#include "strainwave/model/loading/phase_model.hpp"
#include "strainwave/model/meshing/flank_points.hpp"
#include "strainwave/model/meshing/gear_surface.hpp"
#include "strainwave/model/results/load_path.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <optional>

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

// 28 teeth × 6 heights × 5 slices: gaps, selection and contact solve are new; assembly and finite elements
// are not.
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

/// The contact alone: gaps are known and a little different every time, assembly and finite elements are
/// there.
class ContactAlone {
public:
  ContactAlone() : gear(one_load(7.0)) {
    gear.contact.flank_points = 6;
    gear.contact.face_slices = 5;
    responses = unit_responses(response_request(gear)).value();
    ring.emplace(responses, contact_rows(gear), true);
    curve.emplace(NeutralCurve::make(gear.wave_generator, gear.flexspline).value());
    discs.emplace(surface_of(gear, *curve));
    assembled = std::make_shared<const AssembledState>(assemble(*ring, *discs, 0.0, solver).value());
    std::vector<FlankPair> flanks;
    for (const double z : slice_places(responses))
      flanks.push_back(FlankPair::make(gear, face_coordinate(gear.flexspline, z)).value());
    drive = flank_points(gear, responses, backlash(gear, *curve).value(), flanks,
                         [&](int, double phi, int) { return curve->pose(phi); });
    coast = drive;
    std::reverse(coast.begin(), coast.end());
    for (LoadedPoint& point : coast) {
      point.tooth = mirrored_tooth(point.tooth, MeshingPhase{});
      point.phi_rad = -point.phi_rad;
      point.coast = true;
    }
  }
  PhaseLoad solve(double change_um) {
    std::vector<LoadedPoint> moved = drive;
    for (LoadedPoint& point : moved)
      point.backlash_mm += 1e-3 * change_um;
    return PhaseModel(gear.contact, *ring, *discs, assembled, std::move(moved), coast)
        .at_torque(7.0 + change_um, solver)
        .value();
  }

  Gear gear;
  UnitResponses responses;
  std::optional<RingCompliance> ring;
  std::optional<NeutralCurve> curve;
  std::optional<WaveGeneratorSurface> discs;
  std::shared_ptr<const AssembledState> assembled;
  std::vector<LoadedPoint> drive, coast;
  ContactSolver solver;
};

void contact_alone(benchmark::State& state) {
  static ContactAlone contact;
  double change = 0.0;
  int rounds = 0;
  for (auto _ : state)
    rounds = contact.solve(change += 1e-4).rounds;
  state.counters["candidates"] = static_cast<double>(contact.drive.size() + contact.coast.size());
  state.counters["rounds"] = rounds;
}
BENCHMARK(contact_alone)->Unit(benchmark::kMillisecond);

// From event to event to 7 N·m: direct solutions for comparison, exact disc gap and all (finite elements and
// assembly known).
void load_path_of(benchmark::State& state, const Gear& gear) {
  (void)warm_model().load_path(gear).value();
  LoadPath path;
  for (auto _ : state)
    path = warm_model().load_path(gear).value();
  state.counters["events"] = static_cast<double>(path.events.size());
  state.counters["selections"] = path.selections;
}

void load_path_one_point(benchmark::State& state) {
  load_path_of(state, one_load(7.0));
}
BENCHMARK(load_path_one_point)->Unit(benchmark::kMillisecond);

void load_path_linear(benchmark::State& state) {
  Gear gear = one_load(7.0);
  gear.contact.fidelity = Fidelity::linear;
  load_path_of(state, gear);
}
BENCHMARK(load_path_linear)->Unit(benchmark::kMillisecond);

// studies/gallery/seed_coned.toml
void load_path_coned_9x9(benchmark::State& state) {
  Gear gear = one_load(7.0);
  gear.circular_spline.profile_shift = 2.4132;
  gear.contact.window_deg = {-60.0, 51.0};
  gear.contact.flank_points = 9;
  gear.contact.face_slices = 9;
  gear.contact.gaps = GapModel::assembled;
  load_path_of(state, gear);
}
BENCHMARK(load_path_coned_9x9)->Unit(benchmark::kMillisecond);

void backlash_only(benchmark::State& state) {
  Gear gear = one_load(7.0);
  (void)warm_model().analyze(gear); // finite elements and whatever else does not change
  for (auto _ : state)
    benchmark::DoNotOptimize(warm_model().analyze(gear, Want::backlash));
}
BENCHMARK(backlash_only)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace strainwave
