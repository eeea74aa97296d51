#include "strainwave/model/lcp/solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strainwave {

ContactCertificate certify(const ContactProblem& problem, const ContactState& state) {
  ContactCertificate c;
  const int n = problem.size();
  if (n == 0)
    return c;
  if (!state.force.allFinite() || !std::isfinite(state.rotation) || !std::isfinite(state.torque)) {
    c.complementarity = std::numeric_limits<double>::infinity(); // NaN would slip through every comparison
    return c;
  }
  const Eigen::VectorXd load = problem.q - state.rotation * problem.r;
  const Eigen::VectorXd gap = load + problem.m * state.force;
  for (int i = 0; i < n; ++i)
    if (state.force[i] != 0.0 || gap[i] < 0.0)
      c.gap_scale = std::max(c.gap_scale, std::abs(problem.q[i]) + std::abs(state.rotation * problem.r[i]));
  c.force_scale = state.force.cwiseAbs().maxCoeff();
  const auto relative = [](double value, double scale) { return scale > 0.0 ? value / scale : value; };
  double worst = -1.0;
  for (int i = 0; i < n; ++i) {
    const double product = relative(std::abs(state.force[i] * gap[i]), c.force_scale * c.gap_scale);
    c.complementarity = std::max(c.complementarity, product);
    c.min_gap = std::min(c.min_gap, gap[i]);
    c.min_force = std::min(c.min_force, state.force[i]);
    const double violation =
        std::max({product, relative(-gap[i], c.gap_scale), relative(-state.force[i], c.force_scale)});
    if (violation > worst)
      worst = violation, c.worst = i;
  }
  c.torque_error =
      relative(std::abs(problem.r.dot(state.force) - state.torque),
               std::max(std::abs(state.torque), problem.r.cwiseAbs().maxCoeff() * c.force_scale));
  return c;
}

bool ContactCertificate::holds(double tolerance) const {
  return complementarity <= tolerance && min_gap >= -tolerance * gap_scale &&
         min_force >= -tolerance * force_scale && torque_error <= tolerance;
}

} // namespace strainwave
