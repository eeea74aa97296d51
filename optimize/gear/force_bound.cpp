#include "strainwave/optimize/gear/force_bound.hpp"

#include "strainwave/optimize/gear/linear_program.hpp"

#include <algorithm>

namespace strainwave {

namespace {

/// Teeth first … last. Forces in units of `unit_n`, displacements in those of `unit_um`.
std::optional<LinearSolution> solve_set(const std::vector<std::vector<double>>& compliance,
                                        std::span<const double> clearance, std::span<const double> radius,
                                        double torque_nm, double rotation, std::size_t first,
                                        std::size_t last, double unit_n, double unit_um) {
  const std::size_t k = last - first + 1;
  std::vector<LinearRow> rows;
  LinearRow torque{std::vector<double>(k + 1, 0.0), 1.0, true}; // N·mm over T
  for (std::size_t i = 0; i < k; ++i)
    torque.coefficient[i] = 2.0 * radius[first + i] * unit_n / (1e3 * torque_nm);
  rows.push_back(torque);
  for (std::size_t i = 0; i < k; ++i) {
    LinearRow peak{std::vector<double>(k + 1, 0.0), 0.0, false};
    peak.coefficient[i] = 1.0;
    peak.coefficient[k] = -1.0;
    rows.push_back(std::move(peak));
    LinearRow reach{std::vector<double>(k + 1, 0.0), 0.0, false};
    for (std::size_t j = 0; j < k; ++j)
      reach.coefficient[j] = compliance[first + i][first + j] * unit_n / unit_um;
    reach.bound = (1e3 * radius[first + i] * rotation - clearance[first + i]) / unit_um;
    rows.push_back(std::move(reach));
  }
  std::vector<double> cost(k + 1, 0.0);
  cost[k] = 1.0;
  return solve_linear_program(cost, rows);
}

} // namespace

std::optional<ForceBound> least_peak_force(const std::vector<std::vector<double>>& compliance_um_per_n,
                                           std::span<const double> least_clearance_um,
                                           std::span<const double> contact_radius_mm, double torque_nm,
                                           double rotation_rad) {
  const std::size_t n = contact_radius_mm.size();
  std::optional<ForceBound> best;
  for (std::size_t first = 0; first < n; ++first) {
    const double unit_n = 1e3 * torque_nm / (2.0 * contact_radius_mm[first]); // one tooth alone
    const double unit_um = compliance_um_per_n[first][first] * unit_n;
    for (std::size_t last = first; last < n; ++last) {
      const bool out_of_reach = 1e3 * contact_radius_mm[last] * rotation_rad <= least_clearance_um[last];
      if (out_of_reach)
        break; // this tooth, and with it every larger set from `first` on
      const auto solution = solve_set(compliance_um_per_n, least_clearance_um, contact_radius_mm, torque_nm,
                                      rotation_rad, first, last, unit_n, unit_um);
      if (!solution || (best && solution->cost * unit_n >= best->peak_force_n))
        continue;
      best = ForceBound{solution->cost * unit_n, first, last, {}};
      for (std::size_t i = first; i <= last; ++i)
        best->force_n.push_back(solution->x[i - first] * unit_n);
    }
  }
  return best;
}

} // namespace strainwave
