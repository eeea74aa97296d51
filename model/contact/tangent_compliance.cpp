#include "strainwave/model/contact/tangent_compliance.hpp"

#include <stdexcept>

namespace strainwave {

TangentCompliance tangent_compliance(const LoadProblem& load, const Eigen::VectorXd& force_n,
                                     ContactSolver& solver) {
  const Eigen::Index n = load.point_count;
  const Eigen::Index m = load.problem.q.size() - n;
  if (force_n.size() != n)
    throw std::invalid_argument("tangent_compliance: one force for each point");
  const ContactProblem& whole = load.problem;
  TangentCompliance tangent{whole.m.topLeftCorner(n, n), whole.q.head(n), whole.r.head(n), {}};
  if (m == 0)
    return tangent;

  ContactProblem wall;
  wall.m = whole.m.bottomRightCorner(m, m);
  wall.q = whole.q.tail(m) + whole.m.bottomLeftCorner(m, n) * force_n;
  wall.r = Eigen::VectorXd::Zero(m);
  tangent.wall = solver.solve_at(wall, 0.0).active;
  std::vector<Eigen::Index> closed;
  for (Eigen::Index i = 0; i < m; ++i) {
    if (tangent.wall[static_cast<std::size_t>(i)])
      closed.push_back(i);
  }
  if (closed.empty())
    return tangent;
  const Eigen::MatrixXd held = wall.m(closed, closed);
  const Eigen::LLT<Eigen::MatrixXd> factor(held);
  if (factor.info() != Eigen::Success)
    throw NotPositiveDefinite(0, held.diagonal().minCoeff());
  // Y = L⁻¹ M_At: D = M_tt − YᵀY, symmetric by construction
  const Eigen::MatrixXd wall_tooth = whole.m.bottomLeftCorner(m, n);
  const Eigen::VectorXd wall_gap = whole.q.tail(m);
  const Eigen::MatrixXd y = factor.matrixL().solve(Eigen::MatrixXd(wall_tooth(closed, Eigen::all)));
  const Eigen::VectorXd g = factor.matrixL().solve(Eigen::VectorXd(wall_gap(closed)));
  tangent.d.selfadjointView<Eigen::Lower>().rankUpdate(y.transpose(), -1.0);
  tangent.d.triangularView<Eigen::StrictlyUpper>() = tangent.d.transpose();
  tangent.gap_mm -= y.transpose() * g;
  return tangent;
}

} // namespace strainwave
