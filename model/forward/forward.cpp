#include "strainwave/model/forward/forward.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/forward/analysis.hpp"
#include "strainwave/model/forward/inputs.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/kinematics/rim_strain.hpp"
#include "strainwave/model/loading/trace_load.hpp"
#include "strainwave/model/tooth/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strainwave {

namespace {

using units::degree;

WaveGeneratorResult describe(const NeutralCurve& curve, const Flexspline& flexspline) {
  const CurveSummary& s = curve.summary();
  return {.wrap_angle_deg = s.wrap_angle_rad.value_or(0.0) / degree,
          .disc_radius_mm = s.disc_radius_mm.value_or(0.0),
          .eccentricity_mm = s.eccentricity_mm.value_or(0.0),
          .u90_mm = s.u90_mm,
          .rim_strain = rim_strain(curve, flexspline.rim_thickness_mm),
          .shape = std::string(choice_name(curve.shape()))};
}

} // namespace

ForwardResult Analysis::run() {
  const auto failure = guarded_stages();
  for (const char* name : {"kinematics", "backlash", "flexspline", "assembly", "compliance", "load"}) {
    const bool there = std::any_of(result_.stages.begin(), result_.stages.end(),
                                   [&](const Stage& stage) { return stage.name == name; });
    if (!there)
      result_.stages.push_back({name, 0.0, StageStatus::skipped});
  }
  if (failure) {
    result_.status = failure->status;
    result_.message = failure->message;
  }
  return keep_ ? result_ : std::move(result_);
}

Outcome<ContactStates> Analysis::contact_states() {
  try {
    return unguarded_contact_states();
  } catch (const NotPositiveDefinite& error) {
    return ill_conditioned(error);
  }
}

Outcome<ContactStates> Analysis::unguarded_contact_states() {
  if (auto failure = stages())
    return *failure;
  const auto model = phase_model(0.0);
  if (!model)
    return model.failure();
  const auto assembled = assembly(0.0);
  if (!assembled)
    return assembled.failure();
  const RingCompliance& ring = ring_->compliance;
  ContactStates result{.request = response_request(gear_), .states = {}, .warnings = result_.warnings};
  result.states.push_back(
      contact_forces("assembled", ring, **assembled, (*assembled)->force_components(), {}, {}));
  ContactSolver solver;
  const auto add = [&](const std::string& name, const Outcome<PhaseLoad>& load) -> std::optional<Failure> {
    if (!load)
      return load.failure();
    const bool wedged = std::any_of(load->coast_force_n.begin(), load->coast_force_n.end(),
                                    [](double force) { return force > 0.0; });
    result.states.push_back(contact_forces(name, ring, **assembled, load->wall_force,
                                           wedged ? (*model)->all_points() : (*model)->points(),
                                           wedged ? PhaseModel::all_forces(*load) : load->force_n));
    result.states.back().torque_nm = load->torque_nm;
    result.states.back().rotation_rad = load->rotation_rad;
    return std::nullopt;
  };
  for (const double torque : gear_.load.torque_nm) {
    if (auto failure = add(fmt::format("loaded_{:g}Nm", torque), (*model)->at_torque(torque, solver)))
      return *failure;
  }
  for (const double rotation : gear_.load.rotation_rad) {
    if (auto failure =
            add(fmt::format("loaded_{:g}rad", rotation), (*model)->at_rotation(rotation, solver))) {
      return *failure;
    }
  }
  return result;
}

Outcome<LoadPath> Analysis::load_path() {
  try {
    if (auto failure = stages())
      return *failure;
    const auto own = phase_model(0.0);
    if (!own)
      return own.failure();
    const auto assembled = assembly(0.0);
    if (!assembled)
      return assembled.failure();
    const PhaseModel traced(traced_contact(gear_.contact), ring_->compliance, *surface_, *assembled,
                            (*own)->points(), (*own)->coast_points());
    const bool exact = gear_.contact.disc_gap == DiscGap::exact && gear_.contact.fidelity != Fidelity::linear;
    return trace_load(traced, gear_.load, exact ? own->get() : nullptr);
  } catch (const NotPositiveDefinite& error) {
    return ill_conditioned(error);
  }
}

Outcome<std::vector<PhaseProblem>> Analysis::phase_problems(bool with_load) {
  try {
    if (auto failure = stages())
      return *failure;
    std::vector<PhaseProblem> problems;
    for (int j = 0; j < gear_.load.phases; ++j) {
      const double phase = static_cast<double>(j) / gear_.load.phases;
      auto points = loaded_points(phase);
      if (!points)
        return points.failure();
      const auto assembled = assembly(phase);
      if (!assembled)
        return assembled.failure();
      problems.push_back({phase, std::move(points).value(), {}});
      if (!with_load)
        continue;
      const RingCompliance& ring = ring_->compliance;
      PhaseProblem& problem = problems.back();
      problem.load = gear_.contact.fidelity == Fidelity::linear
                         ? linear_problem(ring, **assembled, problem.points)
                         : unilateral_problem(ring, **assembled, problem.points);
    }
    return problems;
  } catch (const NotPositiveDefinite& error) {
    return ill_conditioned(error);
  }
}

Failure Analysis::ill_conditioned(const NotPositiveDefinite& error) const {
  return {Status::ill_conditioned,
          fmt::format(
              "the contact of flexspline and wave generator cannot be solved in double precision: its "
              "compliance has the pivot {:.3g} mm/N (unknown {}); a thickness or contact_width_mm {} is too "
              "small, or youngs_modulus_mpa {} or poisson_ratio {} too extreme, for this cup and mesh",
              error.pivot, error.index, gear_.wave_generator.contact_width_mm,
              gear_.material.youngs_modulus_mpa, gear_.material.poisson_ratio)};
}

std::optional<Failure> Analysis::guarded_stages() {
  try {
    return stages();
  } catch (const NotPositiveDefinite& error) {
    return ill_conditioned(error);
  }
}

std::optional<Failure> Analysis::stages() {
  if (auto contradiction = find_contradiction(gear_))
    return contradiction;
  if (want_ != Want::backlash) {
    if (auto unavailable = find_unavailable(gear_))
      return unavailable;
  }
  if (auto failure = kinematics())
    return failure;
  if (auto failure = first_backlash())
    return failure;
  if (want_ == Want::backlash)
    return std::nullopt;
  if (auto failure = flexspline())
    return failure;
  if (auto failure = first_assembly())
    return failure;
  if (auto failure = backlash_as_assembled())
    return failure;
  if (keep_ && want_ == Want::load)
    return load();
  if (auto failure = compliance())
    return failure;
  if (want_ == Want::compliance)
    return std::nullopt;
  return load();
}

std::optional<Failure> Analysis::kinematics() {
  StageClock clock(result_, "kinematics");
  curve_key_ = curve_key(gear_.wave_generator, gear_.flexspline);
  const auto [curve, reused] = state_.curves.get(curve_key_, [&] {
    return std::make_shared<const Outcome<NeutralCurve>>(
        NeutralCurve::make(gear_.wave_generator, gear_.flexspline));
  });
  clock.done(reused ? StageStatus::reused : StageStatus::computed);
  if (!*curve)
    return curve->failure();
  curve_ = curve;
  result_.wave_generator = describe(**curve, gear_.flexspline);
  return std::nullopt;
}

std::optional<Failure> Analysis::first_backlash() {
  StageClock clock(result_, "backlash");
  Outcome<Backlash> table =
      keep_ ? Outcome<Backlash>(teeth_of_window(gear_, 0.0)) : backlash(gear_, **curve_, 0.0);
  if (!table)
    return table.failure();
  const auto minimum = least_backlash(gear_, **curve_);
  if (!minimum)
    return minimum.failure();
  BacklashResult b;
  if (!keep_)
    b.tooth = table->tooth;
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < b.tooth.size(); ++i) {
    const ToothBacklash& drive = table->drive[i];
    const ToothBacklash& coast = table->coast[i];
    b.phi_deg.push_back(table->phi_rad[i] / degree);
    b.backlash_um.push_back(drive.overlap ? 1e3 * drive.backlash_mm : none);
    b.coast_backlash_um.push_back(coast.overlap ? 1e3 * coast.backlash_mm : none);
    b.contact_radius_mm.push_back(drive.overlap ? drive.contact_radius_mm : none);
  }
  b.min_um = 1e3 * minimum->backlash_mm;
  b.min_phi_deg = minimum->phi_rad / degree;
  b.interference = minimum->backlash_mm < 0.0;
  if (b.interference) {
    result_.message =
        fmt::format("the flanks interfere before any load: least backlash {:.3f} µm at φ = {:.3f}°", b.min_um,
                    b.min_phi_deg);
  }
  result_.backlash = std::move(b);
  tables_.emplace(0.0, std::move(table).value());
  clock.done(StageStatus::computed);
  return std::nullopt;
}

Outcome<std::vector<LoadedPoint>> Analysis::loaded_points(double phase) {
  if (const auto found = points_of_.find(phase); found != points_of_.end())
    return found->second;
  if (!tables_.contains(phase))
    tables_.emplace(phase, teeth_of_window(gear_, phase));
  const UnitResponses& responses = *ring_->responses;
  if (flanks_.empty()) {
    for (const double z : slice_places(responses)) {
      auto pair = FlankPair::make(gear_, face_coordinate(gear_.flexspline, z));
      if (!pair)
        return pair.failure();
      flanks_.push_back(std::move(pair).value());
    }
  }
  PoseSource pose = [&](int, double phi, int) { return (*curve_)->pose(phi); };
  std::optional<AssembledPoses> assembled_poses;
  if (gear_.contact.gaps == GapModel::assembled) {
    const auto assembled = assembly(phase);
    if (!assembled)
      return assembled.failure();
    assembled_poses.emplace(ring_->compliance, **assembled, gear_.flexspline.neutral_radius_mm, phase,
                            slice_places(responses));
    pose = [&](int sector, double phi, int slice) { return assembled_poses->pose(sector, phi, slice); };
  }
  std::vector<LoadedPoint> points = flank_points(gear_, responses, tables_.at(phase), flanks_, pose);
  if (gear_.contact.lobes == 1) {
    std::erase_if(points, [](const LoadedPoint& p) { return std::abs(p.phi_rad) > std::numbers::pi / 2; });
  }
  if (points.empty()) {
    return Failure{Status::no_overlap,
                   "no flank of the flexspline reaches the circular spline in this window: "
                   "no tooth can carry load"};
  }
  if (points_of_.size() >= most_phases_kept)
    points_of_.clear();
  points_of_.emplace(phase, points);
  return points;
}

Outcome<std::vector<LoadedPoint>> Analysis::coast_points(double phase) {
  // Phase n − j mirrors phase j of n; 1 − j/n would miss the other's bits, and with them what it has
  // computed.
  const int phases = gear_.load.phases;
  const double j = std::round(phase * phases);
  const double mirrored = phase == 0.0 ? 0.0 : j / phases == phase ? (phases - j) / phases : 1.0 - phase;
  auto drive = loaded_points(mirrored);
  if (!drive)
    return drive.failure();
  std::vector<LoadedPoint> points = std::move(drive).value();
  std::reverse(points.begin(), points.end());
  for (LoadedPoint& point : points) {
    point.tooth = mirrored_tooth(point.tooth, phase);
    point.phi_rad = 0.0 - point.phi_rad; // 0 − 0 has no sign
    point.coast = true;
  }
  return points;
}

Outcome<std::shared_ptr<const PhaseModel>> Analysis::phase_model(double phase) {
  if (const auto found = phases_.find(phase); found != phases_.end())
    return found->second;
  auto points = loaded_points(phase);
  if (!points)
    return points.failure();
  auto coast = coast_points(phase);
  if (!coast)
    return coast.failure();
  auto assembled = assembly(phase);
  if (!assembled)
    return assembled.failure();
  auto model = std::make_shared<const PhaseModel>(gear_.contact, ring_->compliance, *surface_, *assembled,
                                                  std::move(points).value(), std::move(coast).value());
  if (phases_.size() >= most_phases_kept)
    phases_.clear(); // some MB each
  phases_.emplace(phase, model);
  return model;
}

std::optional<Failure> Analysis::load() {
  StageClock clock(result_, "load");
  const PhaseSource source = [&](double phase) { return phase_model(phase); };
  const LoadObserver keep = [this](const SolvedLoad& solved) { solved_.push_back(solved); };
  if (auto failure = solve_load_cases(gear_, source, result_, keep_ ? keep : LoadObserver()))
    return failure;
  clock.done(StageStatus::computed);
  if (const auto flaw = result_.certificate->find_flaw()) {
    return Failure{Status::certificate_failed, "the certificate does not hold: " + *flaw};
  }
  return std::nullopt;
}

ForwardModel::ForwardModel(ForwardOptions options) : state_(std::make_unique<State>(options)) {}
ForwardModel::~ForwardModel() = default;

ForwardResult ForwardModel::analyze(const Gear& gear, Want want) {
  return Analysis(*state_, gear, want).run();
}

Outcome<LoadPath> ForwardModel::load_path(const Gear& gear) {
  return Analysis(*state_, gear, Want::compliance).load_path();
}

Outcome<std::vector<PhaseProblem>> ForwardModel::phase_problems(const Gear& gear) {
  return Analysis(*state_, gear, Want::compliance).phase_problems(true);
}

Outcome<std::vector<PhaseProblem>> ForwardModel::phase_points(const Gear& gear) {
  return Analysis(*state_, gear, Want::compliance).phase_problems(false);
}

Outcome<ContactStates> ForwardModel::contact_states(const Gear& gear) {
  return Analysis(*state_, gear, Want::compliance).contact_states();
}

} // namespace strainwave
