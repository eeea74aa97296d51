#pragma once
// What no flank can beat: the least peak force that any distribution of clearance reaches at a torque without
// winding up further than allowed. With one contact point per tooth, compliance D of the loaded pairs and
// torque T of both lobes, for every contiguous set S of loaded teeth
//
//     minimise t   subject to   0 ≤ F_i ≤ t,   2 Σ F_i R_i = T,   (D_SS F)_i + c_i ≤ R_i θ     for i in S,
//
// where c_i is the least clearance that the design may give tooth i. The least t over all S is the bound: the
// loaded teeth of every design that keeps θ make such a set, with c_i or more clearance. Teeth outside S may
// simply be cleared.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace strainwave {

struct ForceBound {
  double peak_force_n = 0.0;
  std::size_t first = 0, last = 0; ///< the loaded set, by index
  std::vector<double> force_n;     ///< of its teeth
};

/// compliance_um_per_n: row by row. Nothing if no set carries the torque within the rotation.
std::optional<ForceBound> least_peak_force(const std::vector<std::vector<double>>& compliance_um_per_n,
                                           std::span<const double> least_clearance_um,
                                           std::span<const double> contact_radius_mm, double torque_nm,
                                           double rotation_rad);

} // namespace strainwave
