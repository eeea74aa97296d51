#include "strainwave/optimize/gear/gear_bound.hpp"

#include "strainwave/model/contact/tangent_compliance.hpp"
#include "strainwave/model/loading/phase_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strainwave {

namespace {

/// Points first … first + count − 1 of a phase are those of one tooth.
struct ToothPoints {
  int tooth = 0;
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

std::vector<ToothPoints> group_by_tooth(const std::vector<LoadedPoint>& points) {
  std::vector<ToothPoints> groups;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (groups.empty() || groups.back().tooth != points[i].tooth)
      groups.push_back({points[i].tooth, static_cast<Eigen::Index>(i), 0});
    ++groups.back().count;
  }
  return groups;
}

/// The stiffest share of 1 N over the points of one tooth.
struct StiffestShare {
  double compliance = 0.0; ///< mm/N
  Eigen::VectorXd force;   ///< sums to 1
};

StiffestShare stiffest_share(const Eigen::MatrixXd& d, ContactSolver& solver) {
  const ContactProblem problem{d, Eigen::VectorXd::Zero(d.rows()), Eigen::VectorXd::Ones(d.rows())};
  const auto state = solver.solve_torque(problem, 1.0);
  return {state->force.dot(d * state->force), state->force};
}

/// One phase as the programmes see it: teeth, not points.
struct LumpedPhase {
  std::vector<std::vector<double>> compliance_um_per_n;
  std::vector<double> clearance_um, lever_mm;
  std::vector<Eigen::VectorXd> share; ///< of a tooth's force over its points
};

LumpedPhase lump(const PhaseProblem& phase, const std::vector<ToothPoints>& teeth,
                 const TangentCompliance& tangent, const std::map<int, double>& clearance_mm,
                 ContactSolver& solver) {
  LumpedPhase lumped;
  for (const ToothPoints& a : teeth) {
    lumped.compliance_um_per_n.emplace_back();
    for (const ToothPoints& b : teeth) {
      const auto block = tangent.d.block(a.first, b.first, a.count, b.count);
      if (&a != &b) {
        lumped.compliance_um_per_n.back().push_back(1e3 * block.minCoeff());
        continue;
      }
      StiffestShare own = stiffest_share(block, solver);
      lumped.compliance_um_per_n.back().push_back(1e3 * own.compliance);
      lumped.share.push_back(std::move(own.force));
    }
    double shift = std::numeric_limits<double>::infinity(); // what the wall does without tooth forces
    double clearance = shift, lever = 0.0;
    for (Eigen::Index p = a.first; p < a.first + a.count; ++p) {
      const LoadedPoint& point = phase.points[static_cast<std::size_t>(p)];
      const double cosine = std::cos(point.pressure_angle_rad);
      shift = std::min(shift, tangent.gap_mm(p) - point.backlash_mm * cosine);
      clearance = std::min(clearance, clearance_mm.at(a.tooth) * cosine);
      lever = std::max(lever, tangent.lever_mm(p));
    }
    lumped.clearance_um.push_back(1e3 * (clearance + shift));
    lumped.lever_mm.push_back(lever);
  }
  return lumped;
}

struct PhaseBound {
  std::optional<ForceBound> bound;
  int iterations = 0;
  bool at_rest = false;
};

PhaseBound bound_of_phase(const PhaseProblem& phase, const std::vector<ToothPoints>& teeth,
                          const std::map<int, double>& clearance_mm, double torque_nm, double rotation_rad) {
  constexpr int most_iterations = 12;
  ContactSolver solver;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(phase.load.point_count);
  PhaseBound result;
  ActiveSet before;
  while (result.iterations < most_iterations) {
    const TangentCompliance tangent = tangent_compliance(phase.load, force, solver);
    if (result.iterations > 0 && tangent.wall == before) {
      result.at_rest = true;
      break;
    }
    before = tangent.wall;
    ++result.iterations;
    const LumpedPhase lumped = lump(phase, teeth, tangent, clearance_mm, solver);
    result.bound = least_peak_force(lumped.compliance_um_per_n, lumped.clearance_um, lumped.lever_mm,
                                    torque_nm * 2.0 / phase.load.lobes, rotation_rad);
    if (!result.bound)
      break;
    force.setZero();
    for (std::size_t i = result.bound->first; i <= result.bound->last; ++i) {
      force.segment(teeth[i].first, teeth[i].count) =
          result.bound->force_n[i - result.bound->first] * lumped.share[i];
    }
  }
  return result;
}

/// Flank modifications only take away; what is left of the variables moves or shapes whole flanks.
bool is_removal(const DesignVariable& variable) {
  return variable.path.path().starts_with("flank_modification.");
}

/// Corners of the box of all variables but removals, then its middle.
std::vector<std::vector<double>> corners(const DesignSpace& design, const std::vector<double>& middle) {
  std::vector<std::vector<double>> points{middle};
  for (std::size_t v = 0; v < design.size(); ++v) {
    const DesignVariable& variable = design.variables()[v];
    if (is_removal(variable))
      continue;
    std::vector<std::vector<double>> more;
    for (const std::vector<double>& point : points) {
      for (const double value : {variable.lower, variable.upper}) {
        more.push_back(point);
        more.back()[v] = value;
      }
    }
    points = std::move(more);
  }
  points.push_back(middle);
  return points;
}

} // namespace

Outcome<LeastClearance> least_clearance(const ForwardModel& model, const Gear& base,
                                        const DesignSpace& design, double at_least_mm) {
  std::vector<double> middle;
  for (const DesignVariable& variable : design.variables())
    middle.push_back(is_removal(variable) ? variable.lower : 0.5 * (variable.lower + variable.upper));
  LeastClearance least;
  std::optional<Failure> failure;
  for (const std::vector<double>& x : corners(design, middle)) {
    Gear gear = design.apply(base, x);
    gear.flank_modification = {};
    ++least.corners;
    const auto phases = model.phase_points(gear);
    if (!phases) {
      ++least.without_result;
      failure = phases.failure();
      continue;
    }
    least.by_phase.resize(phases->size());
    for (std::size_t k = 0; k < phases->size(); ++k) {
      for (const LoadedPoint& point : (*phases)[k].points) {
        const double clearance = std::max(point.backlash_mm, at_least_mm);
        const auto [at, fresh] = least.by_phase[k].try_emplace(point.tooth, clearance);
        if (!fresh)
          at->second = std::min(at->second, clearance);
      }
    }
  }
  if (least.by_phase.empty())
    return *failure;
  return least;
}

Outcome<std::optional<GearBound>> gear_force_bound(const ForwardModel& model, const Gear& gear,
                                                   const LeastClearance& clearance, double torque_nm,
                                                   double rotation_rad) {
  const auto phases = model.phase_problems(gear);
  if (!phases)
    return phases.failure();
  std::optional<GearBound> worst;
  for (std::size_t k = 0; k < phases->size(); ++k) {
    const PhaseProblem& phase = (*phases)[k];
    std::map<int, double> clearance_mm = clearance.by_phase[k];
    for (const LoadedPoint& point : phase.points) // teeth that no corner brings into reach
      clearance_mm.try_emplace(point.tooth, point.backlash_mm);
    const auto teeth = group_by_tooth(phase.points);
    const PhaseBound found = bound_of_phase(phase, teeth, clearance_mm, torque_nm, rotation_rad);
    if (!found.bound)
      return std::optional<GearBound>();
    if (worst && found.bound->peak_force_n <= worst->peak_force_n)
      continue;
    worst = GearBound{.peak_force_n = found.bound->peak_force_n,
                      .rotation_rad = rotation_rad,
                      .torque_nm = torque_nm,
                      .phase = phase.phase,
                      .tooth = {},
                      .force_n = found.bound->force_n,
                      .wall_iterations = found.iterations,
                      .wall_at_rest = found.at_rest};
    for (std::size_t i = found.bound->first; i <= found.bound->last; ++i)
      worst->tooth.push_back(teeth[i].tooth);
  }
  return worst;
}

} // namespace strainwave
