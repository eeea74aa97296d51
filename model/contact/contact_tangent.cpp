#include "strainwave/model/contact/contact_tangent.hpp"

#include "strainwave/model/lcp/factor.hpp"

#include <limits>

namespace strainwave {

ContactTangent::ContactTangent(ClosedCompliance compliance, Eigen::VectorXd r, Eigen::VectorXd stiffness)
    : g_(std::move(compliance)), r_(std::move(r)), stiffness_(std::move(stiffness)), teeth_(r_.size()),
      stations_(stiffness_.size()) {
  Eigen::MatrixXd m(teeth_ + stations_, teeth_ + stations_);
  m.topLeftCorner(teeth_, teeth_) = g_.tooth_tooth;
  m.bottomLeftCorner(stations_, teeth_) = -g_.wall_tooth.topRows(stations_);
  m.topRightCorner(teeth_, stations_) = -g_.wall_tooth.topRows(stations_).transpose();
  m.bottomRightCorner(stations_, stations_) = g_.wall_wall.topLeftCorner(stations_, stations_);
  factor_.compute(m);
  if (factor_.info() != Eigen::Success)
    throw NotPositiveDefinite(0, m.diagonal().minCoeff());
  rate_ = Eigen::VectorXd::Zero(m.rows());
  rate_.head(teeth_) = r_;
  factor_.solveInPlace(rate_);
}

StateAnswer ContactTangent::from_turn(const StateChange& change, const Eigen::MatrixXd& turn,
                                      Held held) const {
  Eigen::MatrixXd x(teeth_ + stations_, change.tooth_gap.cols());
  x.topRows(teeth_) = -change.tooth_gap;
  x.bottomRows(stations_) = -change.wall_gap - change.wall_displacement.topRows(stations_);
  if (stations_ > 0) {
    x.topRows(teeth_).noalias() += g_.wall_tooth.bottomRows(stations_).transpose() * turn;
    x.bottomRows(stations_).noalias() -= g_.wall_wall.topRightCorner(stations_, stations_) * turn;
  }
  factor_.solveInPlace(x);
  StateAnswer answer;
  answer.rotation = Eigen::RowVectorXd::Zero(x.cols());
  if (held == Held::torque) {
    answer.rotation = (change.torque - r_.transpose() * x.topRows(teeth_)) / r_.dot(rate_.head(teeth_));
    x.noalias() += rate_ * answer.rotation;
  }
  answer.tooth_force = x.topRows(teeth_);
  answer.wall_normal = x.bottomRows(stations_);
  answer.wall_tangent = turn;
  return answer;
}

Eigen::MatrixXd ContactTangent::tangential(const StateChange& change, const StateAnswer& answer) const {
  Eigen::MatrixXd u = change.wall_displacement.bottomRows(stations_);
  u.noalias() += g_.wall_wall.bottomLeftCorner(stations_, stations_) * answer.wall_normal;
  u.noalias() += g_.wall_wall.bottomRightCorner(stations_, stations_) * answer.wall_tangent;
  u.noalias() -= g_.wall_tooth.bottomRows(stations_) * answer.tooth_force;
  return u;
}

StateAnswer ContactTangent::solve(const StateChange& change, Held held) const {
  constexpr int most_steps = 60;
  const auto turned = [&](const StateAnswer& answer) -> Eigen::MatrixXd {
    return (stiffness_.asDiagonal() * tangential(change, answer)) + change.wall_turn_force;
  };
  StateAnswer answer = from_turn(change, change.wall_turn_force, held);
  if (stations_ == 0 || stiffness_.isZero(0.0))
    return answer;
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::MatrixXd turn = turned(answer);
    const double scale = turn.cwiseAbs().maxCoeff() + answer.wall_normal.cwiseAbs().maxCoeff();
    const double moved = (turn - answer.wall_tangent).cwiseAbs().maxCoeff();
    answer = from_turn(change, turn, held);
    if (moved <= 1e-15 * scale || (moved <= 1e-12 * scale && moved >= 0.5 * before))
      return answer;
    before = moved;
  }
  // No contraction: f = σ u_τ(f) + f₀ is linear in f, so its matrix comes from unit turns.
  StateChange unit{.wall_displacement = Eigen::MatrixXd::Zero(2 * stations_, stations_),
                   .wall_gap = Eigen::MatrixXd::Zero(stations_, stations_),
                   .wall_turn_force = {},
                   .tooth_gap = Eigen::MatrixXd::Zero(teeth_, stations_),
                   .torque = Eigen::RowVectorXd::Zero(stations_)};
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(stations_, stations_);
  const Eigen::MatrixXd own =
      identity - stiffness_.asDiagonal() * tangential(unit, from_turn(unit, identity, held));
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(stations_, change.tooth_gap.cols());
  return from_turn(change, own.partialPivLu().solve(turned(from_turn(change, zero, held))), held);
}

} // namespace strainwave
