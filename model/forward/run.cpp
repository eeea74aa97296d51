#include "strainwave/model/forward/run.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/kinematics/rim_strain.hpp"
#include "strainwave/model/tooth/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>

namespace strainwave {

namespace {

using units::degree;

/// Times a stage and notes how it came about.
class StageClock {
public:
  StageClock(ForwardResult& result, std::string name)
      : result_(result), name_(std::move(name)), start_(std::chrono::steady_clock::now()) {}
  /// A stage that ends without done() has run and failed.
  ~StageClock() {
    if (!noted_)
      done(StageStatus::computed);
  }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;
  void done(StageStatus status) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    result_.stages.push_back({name_, spent.count(), status});
    noted_ = true;
  }

private:
  bool noted_ = false;
  ForwardResult& result_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
};

StageStatus status_of(bool reused) {
  return reused ? StageStatus::reused : StageStatus::computed;
}

WaveGeneratorResult describe(const NeutralCurve& curve, const Flexspline& flexspline) {
  const CurveSummary& s = curve.summary();
  return {.wrap_angle_deg = s.wrap_angle_rad.value_or(0.0) / degree,
          .disc_radius_mm = s.disc_radius_mm.value_or(0.0),
          .eccentricity_mm = s.eccentricity_mm.value_or(0.0),
          .u90_mm = s.u90_mm,
          .rim_strain = rim_strain(curve, flexspline.rim_thickness_mm),
          .shape = std::string(choice_name(curve.shape()))};
}

/// The least backlash, and unless lean that of every tooth.
Outcome<BacklashResult> first_backlash(const Gear& gear, const NeutralCurve& curve, bool lean) {
  BacklashResult b;
  if (!lean) {
    auto table = backlash(gear, curve, 0.0);
    if (!table)
      return table.failure();
    const double none = std::numeric_limits<double>::quiet_NaN();
    b.tooth = table->tooth;
    for (std::size_t i = 0; i < b.tooth.size(); ++i) {
      const ToothBacklash& drive = table->drive[i];
      const ToothBacklash& coast = table->coast[i];
      b.phi_deg.push_back(table->phi_rad[i] / degree);
      b.backlash_um.push_back(drive.overlap ? 1e3 * drive.backlash_mm : none);
      b.coast_backlash_um.push_back(coast.overlap ? 1e3 * coast.backlash_mm : none);
      b.contact_radius_mm.push_back(drive.overlap ? drive.contact_radius_mm : none);
    }
  }
  const auto minimum = least_backlash(gear, curve);
  if (!minimum)
    return minimum.failure();
  b.min_um = 1e3 * minimum->backlash_mm;
  b.min_phi_deg = minimum->phi_rad / degree;
  b.interference = minimum->backlash_mm < 0.0;
  return b;
}

std::optional<Failure> flaw_of(const ForwardResult& result) {
  if (const auto flaw = result.certificate->find_flaw())
    return Failure{Status::certificate_failed, "the certificate does not hold: " + *flaw};
  return std::nullopt;
}

/// The stages in order; each leaves its part of the result and what the next ones need.
class Runner {
public:
  Runner(const std::shared_ptr<SharedStages>& stages, const Gear& gear, const Ask& ask, Run& run)
      : stages_(stages), gear_(gear), ask_(ask), run_(run), result_(run.result) {}

  std::optional<Failure> all() {
    if (auto contradiction = find_contradiction(gear_))
      return contradiction;
    if (ask_.want != Want::backlash)
      if (auto unavailable = find_unavailable(gear_))
        return unavailable;
    const StageInput curve_in = curve_input(gear_);
    const auto curve = kinematics(curve_in);
    if (!curve)
      return curve.failure();
    if (auto failure = backlash_of(**curve))
      return failure;
    if (ask_.want == Want::backlash)
      return std::nullopt;
    const StageInput ring_in = ring_input(gear_, lobes_alike(gear_));
    const auto ring = flexspline(ring_in);
    if (!ring)
      return ring.failure();
    if (auto failure = assembly(assembly_input(gear_, curve_in, ring_in), *curve, *ring))
      return failure;
    if (auto failure = assembled_backlash_of())
      return failure;
    if (!(ask_.lean && ask_.want == Want::load))
      if (auto failure = compliance())
        return failure;
    return ask_.want == Want::compliance ? flaw_of(result_) : load();
  }

private:
  Outcome<std::shared_ptr<const NeutralCurve>> kinematics(const StageInput& input) {
    StageClock clock(result_, "kinematics");
    auto curve = stages_->curve(input);
    clock.done(status_of(curve.reused));
    if (curve.value)
      result_.wave_generator = describe(**curve.value, gear_.flexspline);
    return curve.value;
  }

  std::optional<Failure> backlash_of(const NeutralCurve& curve) {
    StageClock clock(result_, "backlash");
    auto b = first_backlash(gear_, curve, ask_.lean);
    if (!b)
      return b.failure();
    if (b->interference)
      result_.message =
          fmt::format("the flanks interfere before any load: least backlash {:.3f} µm at φ = {:.3f}°",
                      b->min_um, b->min_phi_deg);
    result_.backlash = std::move(b).value();
    clock.done(StageStatus::computed);
    return std::nullopt;
  }

  Outcome<std::shared_ptr<const Ring>> flexspline(const StageInput& input) {
    StageClock clock(result_, "flexspline");
    const auto responses = stages_->responses(response_input(gear_), result_.warnings);
    if (!responses.value)
      return responses.value.failure();
    const auto ring = stages_->ring(input, *responses.value, lobes_alike(gear_));
    clock.done(status_of(responses.reused));
    Certificate certificate;
    certificate.reciprocity = ring->responses->reciprocity_error;
    certificate.discretisation_estimate = ring->responses->discretisation_estimate;
    result_.certificate = certificate;
    return ring;
  }

  std::optional<Failure> assembly(StageInput input, std::shared_ptr<const NeutralCurve> curve,
                                  std::shared_ptr<const Ring> ring) {
    StageClock clock(result_, "assembly");
    bool reused = true;
    const auto shift = disc_shift(*stages_, gear_, input, ring->compliance, *curve, reused);
    if (!shift)
      return shift.failure();
    const auto assembled = stages_->assembly(input, ring->compliance, *curve, *shift, MeshingPhase{});
    if (!assembled.value)
      return assembled.value.failure();
    result_.assembly = describe_assembly(**assembled.value, ring->compliance, *shift);
    run_.cup = std::make_shared<const MountedCup>(stages_, gear_, std::move(curve), std::move(ring),
                                                  std::move(input), *shift);
    clock.done(status_of(reused && assembled.reused));
    return std::nullopt;
  }

  std::optional<Failure> assembled_backlash_of() {
    if (gear_.contact.gaps != GapModel::assembled)
      return std::nullopt;
    const auto assembled = run_.cup->assembly(MeshingPhase{});
    if (!assembled)
      return assembled.failure();
    auto b = backlash_as_assembled(gear_, run_.cup->ring(), **assembled);
    if (!b)
      return b.failure();
    // the kinematic sentence speaks of a cup that does not stand like that
    result_.message.clear();
    if (b->interference)
      result_.message = fmt::format("the flanks of the assembled cup interfere before any load: least "
                                    "backlash {:.3f} µm at φ = {:.3f}°, z = {:.3f} mm",
                                    b->min_um, b->min_phi_deg, b->min_z_mm);
    result_.backlash->assembled = std::move(b).value();
    return std::nullopt;
  }

  std::optional<Failure> mesh() {
    if (run_.meshed)
      return std::nullopt;
    auto flanks = flanks_at(gear_, slice_places(*run_.cup->ring().responses));
    if (!flanks)
      return flanks.failure();
    run_.meshed = std::make_shared<const MeshedGear>(run_.cup, std::move(flanks).value());
    return std::nullopt;
  }

  std::optional<Failure> compliance() {
    StageClock clock(result_, "compliance");
    if (auto failure = mesh())
      return failure;
    const auto points = run_.meshed->points(MeshingPhase{});
    if (!points)
      return points.failure();
    const auto assembled = run_.cup->assembly(MeshingPhase{});
    if (!assembled)
      return assembled.failure();
    result_.compliance = compliance_of_teeth(run_.cup->ring().compliance, **assembled, *points);
    clock.done(StageStatus::computed);
    return std::nullopt;
  }

  std::optional<Failure> load() {
    StageClock clock(result_, "load");
    if (auto failure = mesh())
      return failure;
    const PhaseSource source = [&](MeshingPhase phase) { return run_.meshed->phase_model(phase); };
    const LoadObserver keep = [&](const SolvedLoad& solved) { run_.solved.push_back(solved); };
    if (auto failure = solve_load_cases(gear_, source, result_, ask_.lean ? keep : LoadObserver()))
      return failure;
    clock.done(StageStatus::computed);
    return flaw_of(result_);
  }

  const std::shared_ptr<SharedStages>& stages_;
  const Gear& gear_;
  const Ask& ask_;
  Run& run_;
  ForwardResult& result_;
};

} // namespace

Failure ill_conditioned(const Gear& gear, const NotPositiveDefinite& error) {
  return {Status::ill_conditioned,
          fmt::format(
              "the contact of flexspline and wave generator cannot be solved in double precision: its "
              "compliance has the pivot {:.3g} mm/N (unknown {}); a thickness or contact_width_mm {} is too "
              "small, or youngs_modulus_mpa {} or poisson_ratio {} too extreme, for this cup and mesh",
              error.pivot, error.index, gear.wave_generator.contact_width_mm,
              gear.material.youngs_modulus_mpa, gear.material.poisson_ratio)};
}

std::optional<Failure> run_stages(const std::shared_ptr<SharedStages>& stages, const Gear& gear,
                                  const Ask& ask, Run& run) {
  try {
    return Runner(stages, gear, ask, run).all();
  } catch (const NotPositiveDefinite& error) {
    return ill_conditioned(gear, error);
  }
}

Run complete_run(const std::shared_ptr<SharedStages>& stages, const Gear& gear, const Ask& ask) {
  Run run;
  run.result.gear = gear.name;
  run.result.fidelity = gear.contact.fidelity;
  const auto failure = run_stages(stages, gear, ask, run);
  for (const char* name : {"kinematics", "backlash", "flexspline", "assembly", "compliance", "load"}) {
    const bool there = std::any_of(run.result.stages.begin(), run.result.stages.end(),
                                   [&](const Stage& stage) { return stage.name == name; });
    if (!there)
      run.result.stages.push_back({name, 0.0, StageStatus::skipped});
  }
  if (failure) {
    run.result.status = failure->status;
    run.result.message = failure->message;
  }
  return run;
}

} // namespace strainwave
