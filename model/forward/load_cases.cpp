#include "model/forward/load_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace strainwave {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double arcsec = degree / 3600.0;

/// One asked-for load: torque or rotation.
struct Asked {
  bool torque = true;
  double value = 0.0;
};

int mirrored_tooth(int tooth, double phase) {
  return phase == 0.0 ? -tooth : -1 - tooth;
}

LoadResult present(const PhaseModel& model, const PhaseLoad& load, Direction direction, double phase) {
  LoadResult result;
  result.direction = direction;
  result.rotation_rad = load.rotation_rad;
  result.torque_nm = load.torque_nm;
  result.tangent_stiffness_nm_per_rad = load.tangent_nm_per_rad;
  result.disc_force_n = load.disc_force_n;
  result.gap_correction_rotation_rad = load.gap_correction_rotation_rad;
  result.gap_correction_force_n = load.gap_correction_force_n;
  result.peak_phase = phase;
  const bool coast = direction == Direction::coast;
  const std::vector<LoadedPoint>& points = model.points();
  const std::size_t n = points.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = coast ? n - 1 - k : k; // ascending φ; the points of a tooth stand together
    const LoadedPoint& point = points[i];
    const int tooth = coast ? mirrored_tooth(point.tooth, phase) : point.tooth;
    if (result.tooth.empty() || result.tooth.back() != tooth) {
      result.tooth.push_back(tooth);
      result.phi_deg.push_back((coast ? 0.0 - point.phi_rad : point.phi_rad) / degree); // 0 − 0 has no sign
      result.force_n.push_back(0.0);
      result.loaded_backlash_um.push_back(load.gap_um[i]);
    }
    result.force_n.back() += load.force_n[i];
    result.loaded_backlash_um.back() = std::min(result.loaded_backlash_um.back(), load.gap_um[i]);
    result.points.tooth.push_back(tooth);
    result.points.flank_radius_mm.push_back(point.flank_radius_mm);
    result.points.z_mm.push_back(point.z_mm);
    result.points.force_n.push_back(load.force_n[i]);
    result.points.gap_um.push_back(load.gap_um[i]);
  }
  if (result.tooth.size() == n)
    result.points = {}; // one point a tooth: nothing to add
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
      : gear_(gear), source_(source), result_(result), observer_(observer) {}

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
    return stiffness();
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
      const double scale = std::max(asked.value, leverage);
      const double error = std::abs(load->torque_nm - asked.value);
      if (gear_.contact.method == LoadMethod::event_path)
        raise(result_.certificate->equilibrium, scale > 0.0 ? error / scale : error);
    }
    return load;
  }

  /// Worst over the phases of one pitch; the arrays are those of the phase with the largest tooth force.
  std::optional<Failure> one_case(const Asked& asked, Direction direction) {
    std::optional<LoadResult> worst;
    std::vector<PhaseForces> phases;
    double least_rotation = std::numeric_limits<double>::infinity();
    double most_rotation = -least_rotation;
    for (int j = 0; j < gear_.load.phases; ++j) {
      const double phase = static_cast<double>(j) / gear_.load.phases;
      // the drive-side phase that mirrors it, to the same bits as phase n − j
      const int mirrored = direction == Direction::coast && j > 0 ? gear_.load.phases - j : j;
      const auto model = source_(static_cast<double>(mirrored) / gear_.load.phases);
      if (!model)
        return model.failure();
      const auto load = solve(**model, asked);
      if (!load)
        return load.failure();
      if (observer_)
        observer_({SolvedLoad::Use::load_case, result_.load.size(), direction,
                   static_cast<double>(mirrored) / gear_.load.phases,
                   asked.torque ? Control::torque : Control::rotation, *model, *load});
      least_rotation = std::min(least_rotation, load->rotation_rad);
      most_rotation = std::max(most_rotation, load->rotation_rad);
      LoadResult presented = present(**model, *load, direction, phase);
      phases.push_back({phase, presented.rotation_rad, presented.tooth, presented.force_n});
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
    result_.load.push_back(std::move(*worst));
    return std::nullopt;
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
    const auto model = source_(0.0);
    if (!model)
      return model.failure();
    const auto at_rated = solve(**model, {true, rated});
    if (!at_rated)
      return at_rated.failure();
    const auto at_small = solve(**model, {true, 0.04 * rated});
    if (!at_small)
      return at_small.failure();
    if (observer_) {
      observer_({SolvedLoad::Use::rated, 0, Direction::drive, 0.0, Control::torque, *model, *at_rated});
      observer_({SolvedLoad::Use::small, 0, Direction::drive, 0.0, Control::torque, *model, *at_small});
    }
    StiffnessResult s;
    s.take_up_rad = (*model)->take_up_rad();
    s.wind_up_rad = at_rated->rotation_rad - s.take_up_rad;
    if (!(s.wind_up_rad >
          0.0)) { // interference at rest holds the rated torque, or it is nothing beside rounding
      say(fmt::format(
          "no torsional stiffness: the rated torque {} N·m is reached at {:.6g} rad, take-up is {:.6g} rad",
          rated, at_rated->rotation_rad, s.take_up_rad));
      return std::nullopt;
    }
    s.secant_nm_per_rad = rated / s.wind_up_rad;
    s.lost_motion_arcmin = 2.0 * at_small->rotation_rad / (60.0 * arcsec);
    if (const double overlap = (*model)->least_take_up_rad(); overlap < 0.0) {
      // Between interfering flanks both sides carry at once; this model has the drive flanks alone.
      s.lost_motion_arcmin = std::numeric_limits<double>::quiet_NaN();
      say(fmt::format(
          "flanks interfere before any load (by up to {:.3g} rad of rotation): the coast flanks, which "
          "then touch too, are not part of this solution, and there is no lost motion to state",
          -overlap));
    }
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
  ContactSolver solver_;
};

} // namespace

std::optional<Failure> solve_load_cases(const Gear& gear, const PhaseSource& phase_source,
                                        ForwardResult& result, const LoadObserver& observer) {
  return Cases(gear, phase_source, result, observer).run();
}

} // namespace strainwave
