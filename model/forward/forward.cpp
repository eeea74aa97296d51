#include "model/forward/forward.hpp"

#include "model/forward/load_cases.hpp"
#include "model/forward/pressure_angle.hpp"
#include "model/forward/stage_memory.hpp"
#include "model/flexspline/response_store.hpp"
#include "model/flexspline/responses.hpp"
#include "model/gear/fields.hpp"
#include "model/tooth/backlash.hpp"
#include "model/tooth/consistency.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <algorithm>
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
  void done(StageStatus status) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    result_.stages.push_back({name_, spent.count(), status});
  }

private:
  ForwardResult& result_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
};

ContentKey curve_key(const WaveGenerator& wg, const Flexspline& fs) {
  ContentKey key;
  key.add(static_cast<double>(wg.shape)).add(fs.neutral_radius_mm).add(fs.rim_thickness_mm);
  key.add(wg.max_radial_deformation_mm);
  for (const auto& number : {wg.eccentricity_mm, wg.wrap_angle_deg, wg.force_angle_deg}) {
    key.add(number ? 1.0 : 0.0).add(number.value_or(0.0));
  }
  if (wg.shape == WaveGeneratorShape::table) {
    std::ifstream file(wg.table_file);
    key.add(std::string(std::istreambuf_iterator<char>(file), {}));
  }
  return key;
}

WaveGeneratorResult describe(const NeutralCurve& curve) {
  const CurveSummary& s = curve.summary();
  return {.wrap_angle_deg = s.wrap_angle_rad.value_or(0.0) / degree,
          .disc_radius_mm = s.disc_radius_mm.value_or(0.0),
          .eccentricity_mm = s.eccentricity_mm.value_or(0.0),
          .u90_mm = s.u90_mm,
          .shape = std::string(choice_name(curve.shape()))};
}

/// Rows of the mesh on which the wall's responses are known stand this far apart.
double row_spacing(const Gear& gear) { return gear.flexspline.face_width_mm / gear.mesh.along_face; }

} // namespace

std::optional<Failure> find_unavailable(const Gear& gear) {
  const auto refuse = [](std::string sentence) { return Failure{Status::not_available, std::move(sentence)}; };
  const Contact& c = gear.contact;
  if (c.fidelity == Fidelity::nonlinear || c.assembly == AssemblyModel::nonlinear) {
    return refuse("the nonlinear finite-element check is not in this version; use contact.fidelity = \"unilateral\" and "
                  "contact.assembly = \"small_displacement\"");
  }
  if (c.flank_points != 1 || c.face_slices != 1 || c.gaps != GapModel::kinematic || c.reference_section_mm) {
    return refuse("contact over the whole flank is not in this version; use contact.flank_points = 1, face_slices = 1 and "
                  "gaps = \"kinematic\" without reference_section_mm");
  }
  if (gear.wave_generator.shape == WaveGeneratorShape::four_force && c.fidelity != Fidelity::linear) {
    return refuse("a four_force wave generator has no surface to lift off from; use contact.fidelity = \"linear\"");
  }
  const double overhang = 0.5 * (gear.wave_generator.contact_width_mm - gear.flexspline.face_width_mm);
  if (overhang > row_spacing(gear)) {
    return refuse(fmt::format("wave_generator.contact_width_mm {} reaches {} mm past both ends of face_width_mm {}; the wall's "
                              "compliance is known under the teeth and {} mm (one element) beyond",
                              gear.wave_generator.contact_width_mm, overhang, gear.flexspline.face_width_mm,
                              row_spacing(gear)));
  }
  return std::nullopt;
}

namespace {

/// The ring keeps the responses that it refers to alive.
struct Ring {
  std::shared_ptr<const UnitResponses> responses;
  RingCompliance compliance;
};

/// Rows across the discs where the wall may touch: both edges, which carry nearly all of the force, and the middle. Rows
/// much closer than those of the mesh say the same thing three times, and their compliance is singular to rounding like
/// (width / row spacing)⁴: narrow discs have the middle alone.
std::vector<double> contact_rows(const Gear& gear) {
  const Flexspline& fs = gear.flexspline;
  const WaveGenerator& wg = gear.wave_generator;
  const double middle = fs.cup_length_mm - fs.front_clearance_mm - 0.5 * fs.face_width_mm;
  if (wg.contact_width_mm < 0.1 * row_spacing(gear)) return {middle};
  return {middle - 0.5 * wg.contact_width_mm, middle, middle + 0.5 * wg.contact_width_mm};
}

WaveGeneratorSurface surface_of(const Gear& gear, const NeutralCurve& curve) {
  const Flexspline& fs = gear.flexspline;
  const double half = 0.5 * fs.rim_thickness_mm;
  const CurveSummary& summary = curve.summary();
  if (summary.disc_radius_mm) {
    const double width = gear.wave_generator.contact_width_mm;
    return {WaveGeneratorSurface::Discs{
                .eccentricity_mm = *summary.eccentricity_mm,
                .neutral_disc_radius_mm = *summary.disc_radius_mm,
                .linearised = gear.contact.disc_gap == DiscGap::linearised,
                .taper_per_mm = 1e-3 * gear.wave_generator.disc_taper_um / width,
                .middle_z_mm = fs.cup_length_mm - fs.front_clearance_mm - 0.5 * fs.face_width_mm},
            fs.neutral_radius_mm - half, half};
  }
  return {[curve](double x, double y) {
            const CurveFoot foot = curve.foot(x, y);
            return WaveGeneratorSurface::Foot{foot.distance_mm, foot.normal_angle_rad};
          },
          fs.neutral_radius_mm - half, half};
}

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
  Analysis(ForwardModel::State& state, const Gear& gear, Want want) : state_(state), gear_(gear), want_(want) {
    result_.gear = gear.name;
    result_.fidelity = gear.contact.fidelity;
  }

  ForwardResult run() {
    const auto failure = guarded_stages();
    for (const char* name : {"kinematics", "backlash", "flexspline", "assembly", "compliance", "load"}) {
      const bool there = std::any_of(result_.stages.begin(), result_.stages.end(),
                                     [&](const Stage& stage) { return stage.name == name; });
      if (!there) result_.stages.push_back({name, 0.0, StageStatus::skipped});
    }
    if (failure) {
      result_.status = failure->status;
      result_.message = failure->message;
    }
    return std::move(result_);
  }

private:
  /// A compliance that is not positive definite is one that rounding has eaten up: data of this gear, not our bug.
  std::optional<Failure> guarded_stages() {
    try {
      return stages();
    } catch (const NotPositiveDefinite& error) {
      return Failure{Status::ill_conditioned,
                     fmt::format("the contact of flexspline and wave generator cannot be solved in double precision: its "
                                 "compliance has the pivot {:.3g} mm/N (unknown {}); a thickness or contact_width_mm {} is too "
                                 "small, or youngs_modulus_mpa {} or poisson_ratio {} too extreme, for this cup and mesh",
                                 error.pivot, error.index, gear_.wave_generator.contact_width_mm,
                                 gear_.material.youngs_modulus_mpa, gear_.material.poisson_ratio)};
    }
  }

  std::optional<Failure> stages() {
    if (auto contradiction = find_contradiction(gear_)) return contradiction;
    if (want_ != Want::backlash) {
      if (auto unavailable = find_unavailable(gear_)) return unavailable;
    }
    if (auto failure = kinematics()) return failure;
    if (auto failure = first_backlash()) return failure;
    if (want_ == Want::backlash) return std::nullopt;
    if (auto failure = flexspline()) return failure;
    if (auto failure = first_assembly()) return failure;
    if (auto failure = compliance()) return failure;
    if (want_ == Want::compliance) return std::nullopt;
    return load();
  }

  std::optional<Failure> kinematics() {
    StageClock clock(result_, "kinematics");
    const auto [curve, reused] = state_.curves.get(curve_key(gear_.wave_generator, gear_.flexspline), [&] {
      return std::make_shared<const Outcome<NeutralCurve>>(NeutralCurve::make(gear_.wave_generator, gear_.flexspline));
    });
    clock.done(reused ? StageStatus::reused : StageStatus::computed);
    if (!*curve) return curve->failure();
    curve_ = curve;
    result_.wave_generator = describe(**curve);
    return std::nullopt;
  }

  std::optional<Failure> first_backlash() {
    StageClock clock(result_, "backlash");
    auto table = backlash(gear_, **curve_, 0.0);
    if (!table) return table.failure();
    const auto minimum = least_backlash(gear_, **curve_);
    if (!minimum) return minimum.failure();
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
      result_.message = fmt::format("the flanks interfere before any load: least backlash {:.3f} µm at φ = {:.3f}°", b.min_um,
                                    b.min_phi_deg);
    }
    result_.backlash = std::move(b);
    tables_.emplace(0.0, std::move(table).value());
    clock.done(StageStatus::computed);
    return std::nullopt;
  }

  std::optional<Failure> flexspline() {
    StageClock clock(result_, "flexspline");
    ResponseRequest request;
    request.flexspline = gear_.flexspline;
    request.material = gear_.material;
    request.mesh = gear_.mesh;
    ContentKey key;
    for (const std::uint64_t word : response_key(request)) key.add(std::string_view(reinterpret_cast<const char*>(&word), 8));
    bool from_disk = false;
    const auto [responses, in_memory] = state_.responses.get(key, [&] {
      const ResponseStore store(state_.options.disk_cache ? cache_folder() : std::filesystem::path(),
                                [&](const std::string& sentence) { result_.warnings.push_back(sentence); });
      auto stored = stored_unit_responses(request, store, state_.options.threads);
      if (!stored) return std::make_shared<const Outcome<UnitResponses>>(stored.failure());
      from_disk = stored->reused;
      return std::make_shared<const Outcome<UnitResponses>>(std::move(stored).value().responses);
    });
    if (!*responses) return responses->failure();

    fold_ = gear_.contact.lobes == 2 && gear_.flexspline.teeth % 2 == 0;
    const std::vector<double> rows = contact_rows(gear_);
    ring_key_ = key;
    for (const double row : rows) ring_key_.add(row);
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
    key.add(curve_key(gear_.wave_generator, gear_.flexspline).bits());
    key.add(gear_.wave_generator.disc_taper_um).add(static_cast<double>(gear_.contact.disc_gap)).add(phase);
    const auto [state, known] = state_.assemblies.get(key, [&] {
      const RingCompliance& ring = ring_->compliance;
      if (gear_.wave_generator.shape == WaveGeneratorShape::four_force) {
        return std::make_shared<const Outcome<AssembledState>>(
            hold_at_lines(ring, *gear_.wave_generator.force_angle_deg * degree,
                          (*curve_)->displacement(*gear_.wave_generator.force_angle_deg * degree).u_mm, phase));
      }
      ContactSolver solver;
      return std::make_shared<const Outcome<AssembledState>>(assemble(ring, *surface_, phase, solver));
    });
    if (reused) *reused = known;
    if (!*state) return state->failure();
    return std::shared_ptr<const AssembledState>(state, &state->value());
  }

  std::optional<Failure> first_assembly() {
    StageClock clock(result_, "assembly");
    bool reused = false;
    const auto assembled = assembly(0.0, &reused);
    if (!assembled) return assembled.failure();
    const AssembledState& a = **assembled;
    AssemblyResult out{.contact_force_n = a.disc_force_n,
                       .contact_lo_deg = a.contact_lo_rad / degree,
                       .contact_hi_deg = a.contact_hi_rad / degree,
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

  /// The teeth that can meet their spaces at a phase. lobes = 1: those of the first lobe only.
  Outcome<std::vector<LoadedTooth>> loaded_teeth(double phase) {
    if (!tables_.contains(phase)) {
      auto table = backlash(gear_, **curve_, phase);
      if (!table) return table.failure();
      tables_.emplace(phase, std::move(table).value());
    }
    const Backlash& table = tables_.at(phase);
    std::vector<LoadedTooth> teeth;
    for (std::size_t i = 0; i < table.tooth.size(); ++i) {
      const ToothBacklash& drive = table.drive[i];
      if (!drive.overlap) continue;
      if (gear_.contact.lobes == 1 && std::abs(table.phi_rad[i]) > std::numbers::pi / 2) continue;
      teeth.push_back({.tooth = table.tooth[i],
                       .phi_rad = table.phi_rad[i],
                       .backlash_mm = drive.backlash_mm,
                       .contact_radius_mm = drive.contact_radius_mm,
                       .pressure_angle_rad = gear_.contact.force_direction == ForceDirection::flank_normal
                                                 ? contact_pressure_angle(gear_, (*curve_)->pose(table.phi_rad[i]), drive)
                                                 : 0.0});
    }
    if (teeth.empty()) {
      return Failure{Status::no_overlap, "no flank of the flexspline reaches the circular spline in this window: "
                                         "no tooth can carry load"};
    }
    return teeth;
  }

  std::optional<Failure> compliance() {
    StageClock clock(result_, "compliance");
    auto teeth = loaded_teeth(0.0);
    if (!teeth) return teeth.failure();
    const auto assembled = assembly(0.0);
    if (!assembled) return assembled.failure();
    const RingCompliance& ring = ring_->compliance;
    const Eigen::MatrixXd d = frozen_compliance(ring, **assembled, tooth_functionals(ring, *teeth));
    ComplianceResult out;
    for (const LoadedTooth& tooth : *teeth) out.tooth.push_back(tooth.tooth);
    for (Eigen::Index i = 0; i < d.rows(); ++i) {
      out.matrix_um_per_n.emplace_back();
      for (Eigen::Index j = 0; j < d.cols(); ++j) out.matrix_um_per_n.back().push_back(1e3 * d(i, j));
    }
    out.reciprocity_error = (d - d.transpose()).cwiseAbs().maxCoeff() / d.cwiseAbs().maxCoeff();
    result_.compliance = std::move(out);
    clock.done(StageStatus::computed);
    return std::nullopt;
  }

  std::optional<Failure> load() {
    StageClock clock(result_, "load");
    const PhaseSource source = [&](double phase) -> Outcome<std::shared_ptr<const PhaseModel>> {
      if (const auto found = phases_.find(phase); found != phases_.end()) return found->second;
      auto teeth = loaded_teeth(phase);
      if (!teeth) return teeth.failure();
      auto assembled = assembly(phase);
      if (!assembled) return assembled.failure();
      auto model = std::make_shared<const PhaseModel>(gear_.contact, ring_->compliance, *surface_, *assembled,
                                                      std::move(teeth).value());
      if (phases_.size() >= most_phases_kept) phases_.clear(); // some MB each
      phases_.emplace(phase, model);
      return model;
    };
    if (auto failure = solve_load_cases(gear_, source, result_)) return failure;
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
  ContentKey ring_key_;
  std::shared_ptr<const Ring> ring_;
  std::optional<WaveGeneratorSurface> surface_;
  std::map<double, std::shared_ptr<const PhaseModel>> phases_;
};

ForwardModel::ForwardModel(ForwardOptions options) : state_(std::make_unique<State>(options)) {}
ForwardModel::~ForwardModel() = default;

ForwardResult ForwardModel::analyze(const Gear& gear, Want want) { return Analysis(*state_, gear, want).run(); }

std::optional<std::string> Certificate::find_flaw() const {
  struct Limit {
    const char* name;
    double value, limit;
  };
  const Limit limits[] = {{"complementarity", complementarity, 1e-9},
                          {"min_gap_um", -min_gap_um, 1e-6 + rounding_um},
                          {"min_force_n", -min_force_n, 1e-9},
                          {"reciprocity", reciprocity, 1e-10},
                          {"equilibrium", equilibrium, 1e-9},
                          {"exact_gap_residual_um", exact_gap_residual_um, 1e-6 + rounding_um}};
  for (const Limit& one : limits) {
    if (one.value <= one.limit) continue;
    if (std::isnan(one.value)) return fmt::format("{} is undefined, at most {:.2g} is allowed", one.name, one.limit);
    return fmt::format("{} is off by {:.3g}, at most {:.2g} is allowed", one.name, one.value, one.limit);
  }
  return std::nullopt;
}

} // namespace strainwave
