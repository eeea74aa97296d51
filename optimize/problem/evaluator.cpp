#include "strainwave/optimize/problem/evaluator.hpp"

#include <algorithm>

namespace strainwave {

void take_worse(Certificate& all, const Certificate& one) {
  all.complementarity = std::max(all.complementarity, one.complementarity);
  all.min_gap_um = std::min(all.min_gap_um, one.min_gap_um);
  all.min_force_n = std::min(all.min_force_n, one.min_force_n);
  all.reciprocity = std::max(all.reciprocity, one.reciprocity);
  all.equilibrium = std::max(all.equilibrium, one.equilibrium);
  all.discretisation_estimate = std::max(all.discretisation_estimate, one.discretisation_estimate);
  all.exact_gap_residual_um = std::max(all.exact_gap_residual_um, one.exact_gap_residual_um);
}

} // namespace strainwave
