#include "strainwave/model/loading/load_cases.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/meshing/pressure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace strainwave {

namespace {

using units::arcsec;
using units::degree;

/// One asked-for load: torque or rotation.
struct Asked {
  bool torque = true;
  double value = 0.0;
};

/// What stands in the arrays over teeth and points of one side.
struct Side {
  std::vector<int> tooth;
  std::vector<double> phi_deg, force_n, loaded_backlash_um, pressure_mpa;
  PressurePeak peak_pressure, peak_flank_pressure; ///< of all points; without tip edges
  PointResults points;                             ///< empty with one point a tooth
};

/// Drive or coast points of a load; `mirrored`: as seen in the coast direction.
Side side_of(const std::vector<LoadedPoint>& points, const std::vector<double>& force_n,
             const std::vector<double>& gap_um, bool mirrored, MeshingPhase phase, FlankPressure& pressure) {
  Side side;
  const std::size_t n = points.size();
  const std::vector<LineContact> contacts = pressure.of(points, force_n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = mirrored ? n - 1 - k : k; // ascending φ; the points of a tooth stand together
    const LoadedPoint& point = points[i];
    const int tooth = mirrored ? mirrored_tooth(point.tooth, phase) : point.tooth;
    if (side.tooth.empty() || side.tooth.back() != tooth) {
      side.tooth.push_back(tooth);
      side.phi_deg.push_back((mirrored ? 0.0 - point.phi_rad : point.phi_rad) / degree); // 0 − 0 has no sign
      side.force_n.push_back(0.0);
      side.loaded_backlash_um.push_back(gap_um[i]);
      side.pressure_mpa.push_back(0.0);
    }
    side.force_n.back() += force_n[i];
    side.loaded_backlash_um.back() = std::min(side.loaded_backlash_um.back(), gap_um[i]);
    side.pressure_mpa.back() = std::max(side.pressure_mpa.back(), contacts[i].pressure_mpa);
    if (contacts[i].pressure_mpa > (point.edge ? side.peak_pressure : side.peak_flank_pressure).mpa) {
      const PressurePeak peak{.mpa = contacts[i].pressure_mpa,
                              .tooth = tooth,
                              .phi_deg = side.phi_deg.back(),
                              .flank_radius_mm = point.flank_radius_mm,
                              .z_mm = point.z_mm,
                              .phase = phase.value(),
                              .edge = point.edge};
      if (!point.edge)
        side.peak_flank_pressure = peak;
      if (peak.mpa > side.peak_pressure.mpa)
        side.peak_pressure = peak;
    }
    side.points.tooth.push_back(tooth);
    side.points.flank_radius_mm.push_back(point.flank_radius_mm);
    side.points.z_mm.push_back(point.z_mm);
    side.points.force_n.push_back(force_n[i]);
    side.points.gap_um.push_back(gap_um[i]);
    side.points.contact_radius_mm.push_back(point.contact_radius_mm);
    side.points.half_width_um.push_back(1e3 * contacts[i].half_width_mm);
    side.points.pressure_mpa.push_back(contacts[i].pressure_mpa);
    side.points.edge.push_back(point.edge ? 1 : 0);
  }
  if (side.tooth.size() == n)
    side.points = {}; // one point a tooth: nothing to add
  return side;
}

bool carries(const std::vector<double>& force_n) {
  return std::any_of(force_n.begin(), force_n.end(), [](double force) { return force > 0.0; });
}

LoadResult present(const PhaseModel& model, const PhaseLoad& load, Direction direction, MeshingPhase phase,
                   FlankPressure& pressure) {
  LoadResult result;
  result.direction = direction;
  result.rotation_rad = load.rotation_rad;
  result.torque_nm = load.torque_nm;
  result.tangent_stiffness_nm_per_rad = load.tangent_nm_per_rad;
  result.disc_force_n = load.disc_force_n;
  result.gap_correction_rotation_rad = load.gap_correction_rotation_rad;
  result.gap_correction_force_n = load.gap_correction_force_n;
  result.peak_phase = phase.value();
  const bool mirrored = direction == Direction::coast;
  Side drive = side_of(model.points(), load.force_n, load.gap_um, mirrored, phase, pressure);
  result.tooth = std::move(drive.tooth);
  result.phi_deg = std::move(drive.phi_deg);
  result.force_n = std::move(drive.force_n);
  result.loaded_backlash_um = std::move(drive.loaded_backlash_um);
  result.points = std::move(drive.points);
  result.pressure_mpa = std::move(drive.pressure_mpa);
  result.peak_pressure = drive.peak_pressure;
  result.peak_flank_pressure = drive.peak_flank_pressure;
  if (carries(load.coast_force_n)) {
    Side coast =
        side_of(model.coast_points(), load.coast_force_n, load.coast_gap_um, mirrored, phase, pressure);
    result.coast = {std::move(coast.tooth), std::move(coast.phi_deg), std::move(coast.force_n), 0.0,
                    std::move(coast.points)};
    result.coast.peak_force_n = *std::max_element(result.coast.force_n.begin(), result.coast.force_n.end());
  }
  for (std::size_t i = 0; i < result.tooth.size(); ++i) {
    if (!(result.force_n[i] > 0.0))
      continue;
    // seen from the tooth's own lobe: with an odd number of teeth both are listed
    const double own = result.phi_deg[i] - 180.0 * std::round(result.phi_deg[i] / 180.0);
    result.engaged_lo_deg = result.engaged_count == 0 ? own : std::min(result.engaged_lo_deg, own);
    result.engaged_hi_deg = result.engaged_count == 0 ? own : std::max(result.engaged_hi_deg, own);
    ++result.engaged_count;
    if (result.force_n[i] > result.peak_force_n) {
      result.peak_force_n = result.force_n[i];
      result.peak_phi_deg = result.phi_deg[i];
    }
  }
  return result;
}

class Cases {
public:
  Cases(const Gear& gear, const PhaseSource& source, ForwardResult& result, const LoadObserver& observer)
      : gear_(gear), source_(source), result_(result), observer_(observer), pressure_(gear) {}

  std::optional<Failure> run() {
    std::vector<Asked> asked;
    for (const double torque : gear_.load.torque_nm)
      asked.push_back({true, torque});
    for (const double rotation : gear_.load.rotation_rad)
      asked.push_back({false, rotation});
    for (const Direction direction : {Direction::drive, Direction::coast}) {
      if (gear_.load.direction != Direction::both && gear_.load.direction != direction)
        continue;
      for (const Asked& load : asked) {
        if (auto failure = one_case(load, direction))
          return failure;
      }
    }
    auto failure = stiffness();
    if (!failure)
      say_wedged();
    return failure;
  }

private:
  Outcome<PhaseLoad> solve(const PhaseModel& model, const Asked& asked) {
    auto load =
        asked.torque ? model.at_torque(asked.value, solver_) : model.at_rotation(asked.value, solver_);
    if (load)
      note(*load);
    if (load && asked.torque) {
      // relative to it, or to what the largest force of teeth and wall would make of it
      const double leverage = 1e-3 * gear_.flexspline.tip_radius_mm * load->certificate.force_scale;
      const double scale = std::max(std::abs(asked.value), leverage);
      const double error = std::abs(load->torque_nm - asked.value);
      if (gear_.contact.method == LoadMethod::direct)
        raise(result_.certificate->equilibrium, scale > 0.0 ? error / scale : error);
    }
    return load;
  }

  /// Worst over the phases of one pitch; the arrays are those of the phase with the largest tooth force.
  std::optional<Failure> one_case(const Asked& asked, Direction direction) {
    std::optional<LoadResult> worst;
    std::vector<PhaseForces> phases;
    PressurePeak peak_pressure, peak_flank_pressure;
    double least_rotation = std::numeric_limits<double>::infinity();
    double most_rotation = -least_rotation;
    for (int j = 0; j < gear_.load.phases; ++j) {
      const MeshingPhase phase{j, gear_.load.phases};
      const MeshingPhase drive_phase = direction == Direction::coast ? phase.mirrored() : phase;
      const auto model = source_(drive_phase);
      if (!model)
        return model.failure();
      if (auto failure = rest(**model, drive_phase))
        return failure;
      const auto load = solve(**model, asked);
      if (!load)
        return load.failure();
      if (drive_phase.at_zero() && asked.torque && asked.value == gear_.load.rated_torque_nm)
        at_rated_ = *load;
      if (observer_)
        observer_({SolvedLoad::Use::load_case, result_.load.size(), direction, drive_phase,
                   asked.torque ? Control::torque : Control::rotation, *model, *load});
      least_rotation = std::min(least_rotation, load->rotation_rad);
      most_rotation = std::max(most_rotation, load->rotation_rad);
      LoadResult presented = present(**model, *load, direction, phase, pressure_);
      phases.push_back({phase.value(), presented.rotation_rad, presented.tooth, presented.force_n});
      if (presented.peak_pressure.mpa > peak_pressure.mpa)
        peak_pressure = presented.peak_pressure;
      if (presented.peak_flank_pressure.mpa > peak_flank_pressure.mpa)
        peak_flank_pressure = presented.peak_flank_pressure;
      if (!worst || presented.peak_force_n > worst->peak_force_n)
        worst = std::move(presented);
    }
    if (gear_.load.phases > 1 && asked.torque) {
      worst->transmission_error_arcsec = (most_rotation - least_rotation) / arcsec;
    }
    if (worst->engaged_count == 0 && !asked.torque) {
      say(fmt::format("no tooth is in contact at a rotation of {:.6g} rad", asked.value));
    }
    warn_of_slipping(most_rotation);
    worst->phases = std::move(phases);
    worst->peak_pressure = peak_pressure;
    worst->peak_flank_pressure = peak_flank_pressure;
    result_.load.push_back(std::move(*worst));
    return std::nullopt;
  }

  /// A phase at rest, once: whether flanks overlap at every rotation is plain from the gaps, how hard from a
  /// solution.
  std::optional<Failure> rest(const PhaseModel& model, MeshingPhase phase) {
    if (!rested_.insert(phase).second)
      return std::nullopt;
    const double overlap = model.overlap_rad();
    if (!(overlap > 0.0))
      return std::nullopt;
    const auto load = solve(model, {true, 0.0});
    if (!load)
      return load.failure();
    WedgeResult wedge{.phase = phase.value(),
                      .rotation_rad = load->rotation_rad,
                      .overlap_um = 1e3 * overlap * gear_.flexspline.tip_radius_mm};
    const auto add = [&](const std::vector<LoadedPoint>& points, const std::vector<double>& force_n,
                         const std::vector<double>& gap_um) {
      int count = 0;
      for (const double force : side_of(points, force_n, gap_um, false, phase, pressure_).force_n) {
        wedge.peak_force_n = std::max(wedge.peak_force_n, force);
        wedge.sum_force_n += force;
        count += force > 0.0;
      }
      return count;
    };
    wedge.drive_count = add(model.points(), load->force_n, load->gap_um);
    wedge.coast_count = add(model.coast_points(), load->coast_force_n, load->coast_gap_um);
    if (!result_.wedge || wedge.peak_force_n > result_.wedge->peak_force_n)
      result_.wedge = wedge;
    return std::nullopt;
  }

  void say_wedged() {
    if (const auto& w = result_.wedge) {
      say(fmt::format(
          "drive and coast flanks touch at once: the gear is wedged, at rest with up to {:.3g} N on a flank "
          "({} drive and {} coast flanks carry)",
          w->peak_force_n, w->drive_count, w->coast_count));
      if (gear_.contact.force_direction == ForceDirection::circumferential)
        say("without the flanks' push inwards teeth can only be squeezed: take contact.force_direction = "
            "\"flank_normal\" for "
            "the force of a wedge");
    }
  }

  /// One more sentence beside the numbers.
  void say(const std::string& sentence) {
    if (result_.message.find(sentence) == std::string::npos)
      result_.message += (result_.message.empty() ? "" : "; ") + sentence;
  }

  /// Beyond half a pitch of the circular spline a tooth has reached the next space: no drive works there.
  void warn_of_slipping(double rotation_rad) {
    const double half_pitch = std::numbers::pi / gear_.circular_spline.teeth;
    if (rotation_rad <= half_pitch)
      return;
    say(fmt::format(
        "a load turns the circular spline by {:.4g} rad, more than half a tooth pitch ({:.4g} rad): outside "
        "of "
        "what this model and any gear can do; is the load right, and youngs_modulus_mpa {} in MPa?",
        rotation_rad, half_pitch, gear_.material.youngs_modulus_mpa));
  }

  /// At meshing phase 0, where drive and coast side are mirror images.
  std::optional<Failure> stiffness() {
    const double rated = gear_.load.rated_torque_nm;
    if (!(rated > 0.0))
      return std::nullopt;
    const auto model = source_(MeshingPhase{});
    if (!model)
      return model.failure();
    if (auto failure = rest(**model, MeshingPhase{}))
      return failure;
    const auto at_rated = at_rated_ ? Outcome<PhaseLoad>(*at_rated_) : solve(**model, {true, rated});
    if (!at_rated)
      return at_rated.failure();
    const auto at_small = solve(**model, {true, 0.04 * rated});
    if (!at_small)
      return at_small.failure();
    if (observer_) {
      observer_(
          {SolvedLoad::Use::rated, 0, Direction::drive, MeshingPhase{}, Control::torque, *model, *at_rated});
      observer_(
          {SolvedLoad::Use::small, 0, Direction::drive, MeshingPhase{}, Control::torque, *model, *at_small});
    }
    StiffnessResult s;
    s.take_up_rad = (*model)->take_up_rad();
    s.wind_up_rad = at_rated->rotation_rad - s.take_up_rad;
    if (!(s.wind_up_rad > 0.0)) { // nothing beside rounding
      say(fmt::format(
          "no torsional stiffness: the rated torque {} N·m is reached at {:.6g} rad, take-up is {:.6g} rad",
          rated, at_rated->rotation_rad, s.take_up_rad));
      return std::nullopt;
    }
    s.secant_nm_per_rad = rated / s.wind_up_rad;
    s.lost_motion_arcmin = 2.0 * at_small->rotation_rad / (60.0 * arcsec);
    result_.stiffness = s;
    return std::nullopt;
  }

  /// NaN counts as the worst of all; std::max would lose it.
  static void raise(double& worst, double value) {
    if (!(value <= worst) && !std::isnan(worst))
      worst = value;
  }

  void note(const PhaseLoad& load) {
    Certificate& c = *result_.certificate;
    const auto lower = [](double& worst, double value) {
      if (!(value >= worst) && !std::isnan(worst))
        worst = value;
    };
    const ContactCertificate& solved = load.certificate;
    // Gaps are differences of displacements: measured by the larger of both.
    const double scale = std::max(solved.gap_scale, load.largest_displacement_mm);
    raise(c.complementarity,
          scale > 0.0 ? solved.complementarity * (solved.gap_scale / scale) : solved.complementarity);
    lower(c.min_gap_um, 1e3 * solved.min_gap);
    lower(c.min_force_n, solved.min_force);
    raise(c.equilibrium, solved.torque_error);
    if (scale > 0.0)
      raise(c.equilibrium, load.recomputed_gap_um * 1e-3 / scale);
    raise(c.exact_gap_residual_um, load.exact_gap_residual_um);
    raise(c.rounding_um, load.rounding_um);
  }

  const Gear& gear_;
  const PhaseSource& source_;
  ForwardResult& result_;
  const LoadObserver& observer_;
  std::optional<PhaseLoad> at_rated_; ///< phase 0 at the rated torque, once a load case has been that
  ContactSolver solver_;
  FlankPressure pressure_;
  std::set<MeshingPhase> rested_; ///< drive-side phases whose rest is known
};

} // namespace

int mirrored_tooth(int tooth, MeshingPhase phase) {
  return phase.at_zero() ? -tooth : -1 - tooth;
}

std::optional<Failure> solve_load_cases(const Gear& gear, const PhaseSource& phase_source,
                                        ForwardResult& result, const LoadObserver& observer) {
  return Cases(gear, phase_source, result, observer).run();
}

} // namespace strainwave
