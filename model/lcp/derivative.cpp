#include "strainwave/model/lcp/derivative.hpp"

#include <stdexcept>

namespace strainwave {

ContactSensitivity::ContactSensitivity(const ContactProblem& problem, const ContactState& state, Held held)
    : problem_(problem), held_(held), rotation_(state.rotation), force_(state.force),
      s_(Eigen::VectorXd::Zero(problem.size())), biactive_(state.biactive) {
  std::vector<int> list;
  for (std::size_t i = 0; i < state.active.size(); ++i)
    if (state.active[i])
      list.push_back(static_cast<int>(i));
  factor_.reset(problem.size());
  factor_.factorize(problem, list);
  stiffness_ = factor_.r_r();
  if (held == Held::torque && !(stiffness_ > 0.0))
    throw std::invalid_argument("no tooth carries: a torque cannot be held in this contact state");
  Eigen::VectorXd x(factor_.size());
  factor_.solve(0.0, 1.0, x.data());
  for (int p = 0; p < factor_.size(); ++p)
    s_[list[static_cast<std::size_t>(p)]] = x[p];
}

ContactDerivative ContactSensitivity::of(const ContactFunctional& functional) const {
  const int n = problem_.size();
  ContactDerivative d;
  Eigen::VectorXd weight = functional.force.size() ? functional.force : Eigen::VectorXd::Zero(n);
  d.gap = functional.gap.size() ? functional.gap : Eigen::VectorXd::Zero(n);
  if (weight.size() != n || d.gap.size() != n)
    throw std::invalid_argument("contact functional: the weights have another size than the problem");
  if (functional.gap.size())
    weight += problem_.m * functional.gap;
  const auto order = factor_.order();
  Eigen::VectorXd lambda(factor_.size());
  for (int p = 0; p < factor_.size(); ++p)
    lambda[p] = weight[order[static_cast<std::size_t>(p)]];
  factor_.solve(lambda.data());
  d.control = functional.rotation - d.gap.dot(problem_.r);
  for (int p = 0; p < factor_.size(); ++p)
    d.control += lambda[p] * problem_.r[order[static_cast<std::size_t>(p)]];
  const double mu = held_ == Held::torque ? d.control / stiffness_ : 0.0;
  if (held_ == Held::torque)
    d.control = mu;
  for (int p = 0; p < factor_.size(); ++p) {
    const int i = order[static_cast<std::size_t>(p)];
    d.gap[i] -= lambda[p] - mu * s_[i];
  }
  d.radius = -rotation_ * d.gap - mu * force_;
  d.force = force_;
  d.biactive = biactive_;
  return d;
}

} // namespace strainwave
