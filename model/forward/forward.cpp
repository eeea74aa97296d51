#include "model/forward/forward.hpp"

#include "model/flexspline/response_store.hpp"
#include "model/forward/contact_forces.hpp"
#include "model/forward/flank_points.hpp"
#include "model/forward/inputs.hpp"
#include "model/forward/load_cases.hpp"
#include "model/forward/stage_memory.hpp"
#include "model/gear/fields.hpp"
#include "model/tooth/backlash.hpp"
#include "model/tooth/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <thread>

namespace strainwave {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

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

WaveGeneratorResult describe(const NeutralCurve& curve) {
  const CurveSummary& s = curve.summary();
  return {.wrap_angle_deg = s.wrap_angle_rad.value_or(0.0) / degree,
          .disc_radius_mm = s.disc_radius_mm.value_or(0.0),
          .eccentricity_mm = s.eccentricity_mm.value_or(0.0),
          .u90_mm = s.u90_mm,
          .shape = std::string(choice_name(curve.shape()))};
}

/// D is symmetric by construction, so its own transpose proves nothing. Three of its columns (first, middle, last tooth) are
/// found again from a unit force and the reaction of the held wall, and compared with the rows; relative.
double reciprocity_error(const RingCompliance& ring, const AssembledState& assembled,
                         const std::vector<LoadedPoint>& teeth, const Eigen::MatrixXd& d) {
  const std::vector<ToothFunctional> functionals = tooth_functionals(ring, teeth);
  double error = 0.0;
  for (const Eigen::Index j : {Eigen::Index{0}, d.rows() / 2, d.rows() - 1}) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(d.rows(), j);
    const Eigen::VectorXd column =
        ring.tooth_displacement(functionals, functionals, unit) -
        ring.tooth_displacement(functionals, assembled.stations, frozen_reaction(ring, assembled, functionals, unit));
    error = std::max(error, (column.transpose() - d.row(j)).cwiseAbs().maxCoeff());
  }
  return error / d.cwiseAbs().maxCoeff();
}

/// The ring keeps the responses that it refers to alive.
struct Ring {
  std::shared_ptr<const UnitResponses> responses;
  RingCompliance compliance;
};

} // namespace

struct ForwardModel::State {
  explicit State(ForwardOptions given) : options(given) {}
  ForwardOptions options;
  StageMemory<Outcome<NeutralCurve>> curves{64};
  StageMemory<Outcome<UnitResponses>> responses{8};
  StageMemory<Ring> rings{8};
  StageMemory<Outcome<AssembledState>> assemblies{64};
};

/// One analysis on its way through the stages.
class Analysis {
public:
  Analysis(ForwardModel::State& state, const Gear& gear, Want want)
      : state_(state), gear_(gear), want_(want) {
    result_.gear = gear.name;
    result_.fidelity = gear.contact.fidelity;
  }

  ForwardResult run() {
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
    return std::move(result_);
  }

  Outcome<ContactStates> contact_states() {
    try {
      return unguarded_contact_states();
    } catch (const NotPositiveDefinite& error) {
      return ill_conditioned(error);
    }
  }

private:
  Outcome<ContactStates> unguarded_contact_states() {
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
      result.states.push_back(
          contact_forces(name, ring, **assembled, load->wall_force, (*model)->points(), load->force_n));
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

  /// A compliance that is not positive definite is one that rounding has eaten up: data of this gear, not our bug.
  Failure ill_conditioned(const NotPositiveDefinite& error) const {
    return {Status::ill_conditioned,
            fmt::format(
                "the contact of flexspline and wave generator cannot be solved in double precision: its "
                "compliance has the pivot {:.3g} mm/N (unknown {}); a thickness or contact_width_mm {} is too "
                "small, or youngs_modulus_mpa {} or poisson_ratio {} too extreme, for this cup and mesh",
                error.pivot, error.index, gear_.wave_generator.contact_width_mm,
                gear_.material.youngs_modulus_mpa, gear_.material.poisson_ratio)};
  }

  std::optional<Failure> guarded_stages() {
    try {
      return stages();
    } catch (const NotPositiveDefinite& error) {
      return ill_conditioned(error);
    }
  }

  std::optional<Failure> stages() {
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
    if (auto failure = compliance())
      return failure;
    if (want_ == Want::compliance)
      return std::nullopt;
    return load();
  }

  std::optional<Failure> kinematics() {
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
    result_.wave_generator = describe(**curve);
    return std::nullopt;
  }

  std::optional<Failure> first_backlash() {
    StageClock clock(result_, "backlash");
    auto table = backlash(gear_, **curve_, 0.0);
    if (!table)
      return table.failure();
    const auto minimum = least_backlash(gear_, **curve_);
    if (!minimum)
      return minimum.failure();
    BacklashResult b;
    b.tooth = table->tooth;
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < table->tooth.size(); ++i) {
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
          fmt::format("the flanks interfere before any load: least backlash {:.3f} µm at φ = {:.3f}°",
                      b.min_um, b.min_phi_deg);
    }
    result_.backlash = std::move(b);
    tables_.emplace(0.0, std::move(table).value());
    clock.done(StageStatus::computed);
    return std::nullopt;
  }

  std::optional<Failure> flexspline() {
    StageClock clock(result_, "flexspline");
    const ResponseRequest request = response_request(gear_);
    ContentKey key;
    for (const std::uint64_t word : response_key(request))
      key.add(std::string_view(reinterpret_cast<const char*>(&word), 8));
    bool from_disk = false;
    const auto [responses, in_memory] = state_.responses.get(key, [&] {
      const ResponseStore store(state_.options.disk_cache ? cache_folder() : std::filesystem::path(),
                                [&](const std::string& sentence) { result_.warnings.push_back(sentence); });
      auto stored = stored_unit_responses(request, store, state_.options.threads);
      if (!stored)
        return std::make_shared<const Outcome<UnitResponses>>(stored.failure());
      from_disk = stored->reused;
      return std::make_shared<const Outcome<UnitResponses>>(std::move(stored).value().responses);
    });
    if (!*responses)
      return responses->failure();

    fold_ = gear_.contact.lobes == 2 && gear_.flexspline.teeth % 2 == 0;
    const std::vector<double> rows = contact_rows(gear_);
    ring_key_ = key;
    for (const double row : rows)
      ring_key_.add(row);
    ring_key_.add(fold_ ? 1.0 : 0.0);
    const auto ring = state_.rings.get(ring_key_, [&] {
      const std::shared_ptr<const UnitResponses> shared(responses, &responses->value());
      return std::make_shared<const Ring>(Ring{shared, RingCompliance(*shared, rows, fold_)});
    });
    ring_ = ring.first;
    clock.done(in_memory || from_disk ? StageStatus::reused : StageStatus::computed);
    Certificate certificate;
    certificate.reciprocity = ring_->responses->reciprocity_error;
    certificate.discretisation_estimate = ring_->responses->discretisation_estimate;
    result_.certificate = certificate;
    surface_ = surface_of(gear_, **curve_);
    return std::nullopt;
  }

  /// The cup on the wave generator at a meshing phase.
  Outcome<std::shared_ptr<const AssembledState>> assembly(double phase, bool* reused = nullptr) {
    ContentKey key = ring_key_;
    key.add(curve_key_.bits());
    key.add(gear_.wave_generator.disc_taper_um)
        .add(static_cast<double>(gear_.contact.disc_gap))
        .add(disc_shift_)
        .add(phase);
    const auto [state, known] = state_.assemblies.get(key, [&] {
      const RingCompliance& ring = ring_->compliance;
      if (gear_.wave_generator.shape == WaveGeneratorShape::four_force) {
        return std::make_shared<const Outcome<AssembledState>>(hold_at_lines(
            ring, *gear_.wave_generator.force_angle_deg * degree,
            (*curve_)->displacement(*gear_.wave_generator.force_angle_deg * degree).u_mm, phase));
      }
      ContactSolver solver;
      return std::make_shared<const Outcome<AssembledState>>(assemble(ring, *surface_, phase, solver));
    });
    if (reused)
      *reused = *reused && known;
    if (!*state)
      return state->failure();
    return std::shared_ptr<const AssembledState>(state, &state->value());
  }

  /// Moves the discs until the neutral surface stands at u0 in the reference section, by the secant method.
  std::optional<Failure> shift_discs(bool& reused) {
    if (!gear_.contact.reference_section_mm)
      return std::nullopt;
    constexpr double tolerance_mm = 1e-9;
    double before = 0.0;
    double excess_before = 0.0;
    for (int step = 0; step < 30; ++step) {
      surface_ = surface_of(gear_, **curve_, disc_shift_);
      const auto assembled = assembly(0.0, &reused);
      if (!assembled)
        return assembled.failure();
      const AssembledPoses poses(ring_->compliance, **assembled, gear_.flexspline.neutral_radius_mm, 0.0,
                                 {*gear_.contact.reference_section_mm});
      const double excess = poses.radial(0.0, 0) - gear_.wave_generator.max_radial_deformation_mm;
      if (std::abs(excess) < tolerance_mm)
        return std::nullopt;
      const double slope = step > 0 ? (excess - excess_before) / (disc_shift_ - before) : 1.0;
      before = disc_shift_;
      excess_before = excess;
      disc_shift_ -= excess / slope;
      if (!(std::abs(disc_shift_) < 0.2 * gear_.flexspline.neutral_radius_mm))
        break; // slope lost
    }
    return Failure{Status::not_converged,
                   fmt::format("no shift of the discs brings the section at z = {} mm to u0 = {} mm",
                               *gear_.contact.reference_section_mm,
                               gear_.wave_generator.max_radial_deformation_mm)};
  }

  std::optional<Failure> first_assembly() {
    StageClock clock(result_, "assembly");
    bool reused = true;
    if (auto failure = shift_discs(reused))
      return failure;
    const auto assembled = assembly(0.0, &reused);
    if (!assembled)
      return assembled.failure();
    const AssembledState& a = **assembled;
    AssemblyResult out{.contact_force_n = a.disc_force_n,
                       .contact_lo_deg = a.contact_lo_rad / degree,
                       .contact_hi_deg = a.contact_hi_rad / degree,
                       .disc_shift_mm = disc_shift_,
                       .newton_steps = a.newton_steps};
    const int middle_row = static_cast<int>(ring_->compliance.rows_mm().size() / 2);
    for (std::size_t i = 0; i < a.stations.size(); ++i) { // phase 0: a station stands on the major axis
      if (a.stations[i].row == middle_row && std::abs(a.stations[i].phi_rad) < 1e-9) {
        out.radial_deformation_mm = a.displacement(static_cast<Eigen::Index>(i), 0);
      }
    }
    result_.assembly = out;
    clock.done(reused ? StageStatus::reused : StageStatus::computed);
    return std::nullopt;
  }

  /// The points that can meet their spaces at a phase. lobes = 1: those of the first lobe only.
  Outcome<std::vector<LoadedPoint>> loaded_points(double phase) {
    if (!tables_.contains(phase)) {
      auto table = backlash(gear_, **curve_, phase);
      if (!table)
        return table.failure();
      tables_.emplace(phase, std::move(table).value());
    }
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
    return points;
  }

  std::optional<Failure> compliance() {
    StageClock clock(result_, "compliance");
    const auto points = loaded_points(0.0);
    if (!points)
      return points.failure();
    const auto assembled = assembly(0.0);
    if (!assembled)
      return assembled.failure();
    const RingCompliance& ring = ring_->compliance;
    std::vector<LoadedPoint> of_teeth; // the point of least take-up of every tooth
    for (const LoadedPoint& point : *points) {
      if (of_teeth.empty() || of_teeth.back().tooth != point.tooth) {
        of_teeth.push_back(point);
      } else if (point.backlash_mm / point.contact_radius_mm <
                 of_teeth.back().backlash_mm / of_teeth.back().contact_radius_mm) {
        of_teeth.back() = point;
      }
    }
    const Eigen::MatrixXd d = frozen_compliance(ring, **assembled, tooth_functionals(ring, of_teeth));
    ComplianceResult out;
    for (const LoadedPoint& point : of_teeth)
      out.tooth.push_back(point.tooth);
    for (Eigen::Index i = 0; i < d.rows(); ++i) {
      out.matrix_um_per_n.emplace_back();
      for (Eigen::Index j = 0; j < d.cols(); ++j)
        out.matrix_um_per_n.back().push_back(1e3 * d(i, j));
    }
    out.reciprocity_error = reciprocity_error(ring, **assembled, of_teeth, d);
    result_.compliance = std::move(out);
    clock.done(StageStatus::computed);
    if (want_ == Want::compliance) {
      if (const auto flaw = result_.certificate->find_flaw())
        return Failure{Status::certificate_failed, "the certificate does not hold: " + *flaw};
    }
    return std::nullopt;
  }

  Outcome<std::shared_ptr<const PhaseModel>> phase_model(double phase) {
    if (const auto found = phases_.find(phase); found != phases_.end())
      return found->second;
    auto points = loaded_points(phase);
    if (!points)
      return points.failure();
    auto assembled = assembly(phase);
    if (!assembled)
      return assembled.failure();
    auto model = std::make_shared<const PhaseModel>(gear_.contact, ring_->compliance, *surface_, *assembled,
                                                    std::move(points).value());
    if (phases_.size() >= most_phases_kept)
      phases_.clear(); // some MB each
    phases_.emplace(phase, model);
    return model;
  }

  std::optional<Failure> load() {
    StageClock clock(result_, "load");
    const PhaseSource source = [&](double phase) { return phase_model(phase); };
    if (auto failure = solve_load_cases(gear_, source, result_))
      return failure;
    clock.done(StageStatus::computed);
    if (const auto flaw = result_.certificate->find_flaw()) {
      return Failure{Status::certificate_failed, "the certificate does not hold: " + *flaw};
    }
    return std::nullopt;
  }

  static constexpr std::size_t most_phases_kept = 64;

  ForwardModel::State& state_;
  const Gear& gear_;
  Want want_;
  ForwardResult result_;
  std::shared_ptr<const Outcome<NeutralCurve>> curve_;
  std::map<double, Backlash> tables_;
  bool fold_ = true;
  ContentKey curve_key_;
  ContentKey ring_key_;
  std::shared_ptr<const Ring> ring_;
  std::optional<WaveGeneratorSurface> surface_;
  double disc_shift_ = 0.0;
  std::vector<FlankPair> flanks_; ///< one for each slice
  std::map<double, std::shared_ptr<const PhaseModel>> phases_;
};

ForwardModel::ForwardModel(ForwardOptions options) : state_(std::make_unique<State>(options)) {}
ForwardModel::~ForwardModel() = default;

ForwardResult ForwardModel::analyze(const Gear& gear, Want want) {
  return Analysis(*state_, gear, want).run();
}

Outcome<ContactStates> ForwardModel::contact_states(const Gear& gear) {
  return Analysis(*state_, gear, Want::compliance).contact_states();
}

} // namespace strainwave
