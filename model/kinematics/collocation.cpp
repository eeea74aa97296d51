#include "strainwave/model/kinematics/collocation.hpp"

#include "strainwave/common/core/units.hpp"

#include <Eigen/LU>

#include <cmath>

namespace strainwave {
namespace {

using units::pi;
using units::right_angle;

/// The integrated equations at n points. Unknowns: psi at the points, then a, h, e.
class Collocation {
public:
  Collocation(const ElasticaProblem& problem, int points) : problem_(problem), grid_(chebyshev_grid(points)) {
    twice_ = grid_.integral * grid_.integral;
  }

  const ChebyshevGrid& grid() const { return grid_; }

  Eigen::VectorXd start(const LiftOff& lift_off) const {
    const double radius = problem_.neutral_radius_mm + problem_.u0_mm - lift_off.eccentricity_mm;
    const double half = 0.5 * (right_angle * problem_.neutral_radius_mm - radius * lift_off.arc_rad);
    Eigen::VectorXd x(grid_.size + 3);
    // From lift-off to pi with the given initial curvature: near enough for Newton, the true psi is almost
    // straight.
    for (int j = 0; j < grid_.size; ++j) {
      const double way = 0.5 * (grid_.nodes[j] + 1.0), begin = right_angle + lift_off.arc_rad;
      const double slope = 2.0 * half / radius;
      x[j] = begin + slope * way + (pi - begin - slope) * way * way;
    }
    x.tail<3>() << lift_off.arc_rad, lift_off.n_over_ei_per_mm2, lift_off.eccentricity_mm;
    return x;
  }

  /// Residual F, Jacobian dF/dx, and dF/d(r_m, u0, given).
  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& f, Eigen::MatrixXd& jacobian,
                Eigen::Matrix<double, Eigen::Dynamic, 3>& by_parameter) const {
    const int n = grid_.size;
    const double a = x[n], h = x[n + 1], e = x[n + 2];
    const double radius = problem_.neutral_radius_mm + problem_.u0_mm - e;
    const double half = 0.5 * (right_angle * problem_.neutral_radius_mm - radius * a);
    // Derivatives of R and l with respect to a, e and to r_m, u0.
    const double half_a = -0.5 * radius, half_e = 0.5 * a, half_rm = 0.5 * (right_angle - a),
                 half_u0 = -0.5 * a;
    const double ratio = half / radius; // l/R
    const auto ratio_by = [&](double half_by, double radius_by) {
      return (half_by - ratio * radius_by) / radius;
    };

    const Eigen::VectorXd sine = x.head(n).array().sin(), cosine = x.head(n).array().cos();
    const Eigen::VectorXd forward = grid_.nodes.array() + 1.0, bend = twice_ * sine;
    const Eigen::VectorXd weights = grid_.integral.row(n - 1).transpose();
    const double half2_h = half * half * h, width = weights.dot(cosine);

    f.resize(n + 3);
    f.head(n) = x.head(n) - Eigen::VectorXd::Constant(n, right_angle + a) - ratio * forward - half2_h * bend;
    f[n] = x[n - 1] - pi;
    f[n + 1] = e + radius * std::cos(a) + half * width;
    const double lx = e + radius * std::cos(a), ly = radius * std::sin(a);
    f[n + 2] = problem_.eccentricity_given ? e - problem_.given : std::atan2(ly, lx) - problem_.given;

    jacobian.setZero(n + 3, n + 3);
    jacobian.topLeftCorner(n, n) = -half2_h * (twice_ * cosine.asDiagonal());
    jacobian.topLeftCorner(n, n).diagonal().array() += 1.0;
    const auto equation_by = [&](double half_by, double radius_by) -> Eigen::VectorXd {
      return -ratio_by(half_by, radius_by) * forward - (2.0 * half * half_by * h) * bend;
    };
    jacobian.col(n).head(n) = equation_by(half_a, 0.0).array() - 1.0;
    jacobian.col(n + 1).head(n) = -half * half * bend;
    jacobian.col(n + 2).head(n) = equation_by(half_e, -1.0);
    jacobian(n, n - 1) = 1.0;
    jacobian.row(n + 1).head(n) = -half * weights.cwiseProduct(sine).transpose();
    jacobian(n + 1, n) = -radius * std::sin(a) + half_a * width;
    jacobian(n + 1, n + 2) = 1.0 - std::cos(a) + half_e * width;
    by_parameter.setZero(n + 3, 3);
    by_parameter.col(0).head(n) = equation_by(half_rm, 1.0);
    by_parameter.col(1).head(n) = equation_by(half_u0, 1.0);
    by_parameter(n + 1, 0) = std::cos(a) + half_rm * width;
    by_parameter(n + 1, 1) = std::cos(a) + half_u0 * width;
    by_parameter(n + 2, 2) = -1.0;
    if (problem_.eccentricity_given) {
      jacobian(n + 2, n + 2) = 1.0;
    } else {
      const double square = lx * lx + ly * ly;
      const auto polar_by = [&](double x_by, double y_by) { return (lx * y_by - ly * x_by) / square; };
      jacobian(n + 2, n) = polar_by(-radius * std::sin(a), radius * std::cos(a));
      jacobian(n + 2, n + 2) = polar_by(1.0 - std::cos(a), -std::sin(a));
      by_parameter(n + 2, 0) = by_parameter(n + 2, 1) = polar_by(std::cos(a), std::sin(a));
    }
  }

private:
  ElasticaProblem problem_;
  const ChebyshevGrid& grid_;
  Eigen::MatrixXd twice_;
};

} // namespace

std::optional<FreeArcSolution> collocate(const ElasticaProblem& problem, const LiftOff& start) {
  for (int points : {16, 24, 32, 48, 64}) {
    const Collocation collocation(problem, points);
    Eigen::VectorXd x = collocation.start(start), residual;
    Eigen::MatrixXd jacobian;
    Eigen::Matrix<double, Eigen::Dynamic, 3> by_parameter;
    Eigen::PartialPivLU<Eigen::MatrixXd> factors;
    double step = 1.0;
    for (int iteration = 0; iteration < 12 && step > 1e-13; ++iteration) {
      collocation.evaluate(x, residual, jacobian, by_parameter);
      factors.compute(jacobian);
      const Eigen::VectorXd correction = factors.solve(residual);
      x -= correction;
      step = correction.head(points).cwiseAbs().maxCoeff();
    }
    const Eigen::VectorXd series = collocation.grid().coefficients * x.head(points);
    if (!(step < 1e-11) || (chebyshev_tail(series) > 1e-15 && points < 64))
      continue;
    const Eigen::Matrix<double, Eigen::Dynamic, 3> by = -factors.solve(by_parameter);
    FreeArcSolution solution;
    solution.grid = &collocation.grid();
    solution.psi = x.head(points);
    solution.lift_off = {x[points], x[points + 1], x[points + 2]};
    solution.psi_by = by.topRows(points);
    solution.lift_off_by.row(0) = by.row(points);
    solution.lift_off_by.row(1) = by.row(points + 2);
    return solution;
  }
  return std::nullopt;
}

} // namespace strainwave
