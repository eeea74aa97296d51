#include "strainwave/studies/search/bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace strainwave {

namespace {

double largest_rotation(const LoadResult& load) {
  double rotation = load.rotation_rad;
  for (const PhaseForces& phase : load.phases)
    rotation = std::max(rotation, phase.rotation_rad);
  return rotation;
}

/// Upper limit of rotation_rad, least clearance demanded (mm): what every design of the study keeps.
struct Demands {
  std::optional<double> rotation_rad;
  double clearance_mm = -std::numeric_limits<double>::infinity();
};

Demands demands(const OptimisationReport& report) {
  Demands all;
  for (const LimitReport& l : report.limits) {
    const std::string_view name = gear_responses()[l.limit.response].name;
    if (name == "rotation_rad" && l.limit.upper)
      all.rotation_rad = std::min(l.limit.bound, all.rotation_rad.value_or(l.limit.bound));
    if (name == "min_backlash_um" && !l.limit.upper)
      all.clearance_mm = std::max(all.clearance_mm, 1e-3 * l.limit.bound);
    if (name == "interference_um" && l.limit.upper)
      all.clearance_mm = std::max(all.clearance_mm, -1e-3 * l.limit.bound);
  }
  return all;
}

/// Torques in the drive direction alone.
bool is_bounded(const StudyFile& study, const std::vector<Load>& loads) {
  return study.part<SearchPart>().objective.output == "peak_force_n" &&
         study.part<SearchPart>().objective.goal == Goal::minimise &&
         std::all_of(loads.begin(), loads.end(), [](const Load& load) {
           return load.rotation_rad.empty() && load.direction == Direction::drive;
         });
}

} // namespace

void report_bound(OptimisationReport& report, const DesignSpace& design, const std::vector<Load>& loads,
                  const ForwardModel& model) {
  if (!report.best_gear || !is_bounded(report.study, loads))
    return;
  const Demands demanded = demands(report);
  double largest_torque = 0.0;
  for (const Load& load : loads)
    for (const double torque : load.torque_nm)
      largest_torque = std::max(largest_torque, torque);
  for (const Load& load : loads) {
    Gear base = report.study.gear;
    Gear best = *report.best_gear;
    base.load = best.load = load;
    const ForwardResult result = model.analyze(best);
    const auto clearance = least_clearance(model, base, design, demanded.clearance_mm);
    if (result.status != Status::ok || !clearance) {
      report.no_bound = clearance ? result.message : clearance.failure().message;
      return;
    }
    for (std::size_t k = 0; k < load.torque_nm.size(); ++k) {
      const double torque = load.torque_nm[k];
      const bool limited = demanded.rotation_rad && torque == largest_torque;
      const double rotation = limited ? *demanded.rotation_rad : largest_rotation(result.load[k]);
      const auto bound = gear_force_bound(model, best, *clearance, torque, rotation);
      if (!bound || !*bound) {
        report.no_bound =
            bound ? fmt::format("no set of teeth carries {} N·m within {:.6g} rad", torque, rotation)
                  : bound.failure().message;
        return;
      }
      const double peak = result.load[k].peak_force_n;
      if (!report.bound ||
          (*bound)->peak_force_n * report.bound->optimum_n > report.bound->bound.peak_force_n * peak)
        report.bound = BoundReport{**bound, peak, limited ? "the limit" : "the optimum's own"};
    }
  }
}

std::string bound_sentence(const OptimisationReport& report) {
  if (!report.no_bound.empty())
    return "none: " + report.no_bound;
  if (!report.bound)
    return "";
  const GearBound& bound = report.bound->bound;
  return fmt::format(
      "{:.2f} N: no clearance of single teeth carries {} N·m with less within {:.4e} rad ({}); "
      "{} teeth share it then. The optimum lies {:.0f} % above",
      bound.peak_force_n, bound.torque_nm, bound.rotation_rad, report.bound->rotation_from,
      bound.tooth.size(), 100.0 * (report.bound->optimum_n / bound.peak_force_n - 1.0));
}

} // namespace strainwave
