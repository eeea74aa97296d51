// Two discs, geometrically exact: an inextensible elastica of length 2 pi r_m on two rigid discs (centres
// (+-e, 0), radius R = r_m + u0 - e to the neutral line). On the disc the curve is the arc; the free part
// obeys psi'' = h sin psi. shooting.hpp finds the solution to about 1e-9, collocation.hpp brings it to
// rounding; here it is stored as series of x, y, psi along the free arc, beside the series of their
// derivatives, so that a pose is one sum. Seed gear: lift-off at 50.342648 degrees about the disc's centre,
// N/EI = -0.00210823 mm^-2.

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/kinematics/collocation.hpp"
#include "strainwave/model/kinematics/curve_shape.hpp"
#include "strainwave/model/kinematics/derivative.hpp"
#include "strainwave/model/kinematics/wrap.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace strainwave {
namespace {

using units::pi;
using units::right_angle;

class Elastica final : public CurveShape {
public:
  Elastica(const ElasticaProblem& problem, const FreeArcSolution& solution)
      : radius_m_(problem.neutral_radius_mm), size_(solution.grid->size) {
    const ChebyshevGrid& grid = *solution.grid;
    const int n = size_;
    const Number rm(radius_m_, 3, 0), u0(problem.u0_mm, 3, 1);
    arc_ = Number(solution.lift_off.arc_rad, solution.lift_off_by.row(0).transpose());
    e_ = Number(solution.lift_off.eccentricity_mm, solution.lift_off_by.row(1).transpose());
    n_over_ei_ = solution.lift_off.n_over_ei_per_mm2;
    radius_ = rm + u0 - e_;
    lift_off_s_ = radius_ * arc_;
    half_ = Number(0.5 * (right_angle * rm - lift_off_s_));
    const Number lift_x = e_ + radius_ * cos(arc_), lift_y = radius_ * sin(arc_);
    lift_off_polar_ = std::atan2(lift_y.value(), lift_x.value());
    // x, y, psi at the nodes, then their derivatives with respect to each parameter at fixed t.
    Eigen::MatrixXd at_nodes(n, 12);
    const Eigen::VectorXd sine = solution.psi.array().sin(), cosine = solution.psi.array().cos();
    const Eigen::VectorXd along_x = grid.integral * cosine, along_y = grid.integral * sine;
    const double half = half_.value();
    at_nodes.col(0) = half * along_x.array() + lift_x.value();
    at_nodes.col(1) = half * along_y.array() + lift_y.value();
    at_nodes.col(2) = solution.psi;
    for (Eigen::Index p = 0; p < 3; ++p) {
      const Eigen::VectorXd turn = solution.psi_by.col(p);
      at_nodes.col(3 + 3 * p) = half_.derivatives()[p] * along_x.array() + lift_x.derivatives()[p] -
                                (half * (grid.integral * sine.cwiseProduct(turn))).array();
      at_nodes.col(4 + 3 * p) = half_.derivatives()[p] * along_y.array() + lift_y.derivatives()[p] +
                                (half * (grid.integral * cosine.cwiseProduct(turn))).array();
      at_nodes.col(5 + 3 * p) = turn;
    }
    const Eigen::MatrixXd coefficients = grid.coefficients * at_nodes;
    values_.resize(static_cast<std::size_t>(3 * n));
    derivatives_.resize(static_cast<std::size_t>(9 * n));
    for (int k = 0; k < n; ++k)
      for (int m = 0; m < 12; ++m) {
        if (m < 3)
          values_[static_cast<std::size_t>(3 * k + m)] = coefficients(k, m);
        else
          derivatives_[static_cast<std::size_t>(9 * k + m - 3)] = coefficients(k, m);
      }
  }

  CurveSummary summary() const override {
    const double u0 = radius_.value() + e_.value() - radius_m_;
    return {.u0_mm = u0,
            .u90_mm = pose(right_angle).rho_mm - radius_m_,
            .perimeter_excess_mm = 0.0,
            .wrap_angle_rad = lift_off_polar_,
            .lift_off_arc_rad = arc_.value(),
            .n_over_ei_per_mm2 = n_over_ei_,
            .eccentricity_mm = e_.value(),
            .disc_radius_mm = radius_.value()};
  }

  Pose pose(double phi) const override {
    const Point p = point(radius_m_ * phi);
    const double polar = std::atan2(p.y, p.x);
    return {std::hypot(p.x, p.y), polar, p.psi - right_angle - polar};
  }

  PoseDerivatives pose_derivatives(double phi) const override {
    const double s = radius_m_ * phi;
    const Point p = point(s);
    // Columns: s, then r_m, u0, given number at fixed s.
    std::array<double, 4> dx{std::cos(p.psi)}, dy{std::sin(p.psi)}, dpsi{p.curvature};
    if (s <= lift_off_s_.value()) {
      const Number angle = s / radius_;
      const Number x = e_ + radius_ * cos(angle), y = radius_ * sin(angle);
      for (std::size_t j = 0; j < 3; ++j) {
        const auto at = static_cast<Eigen::Index>(j);
        dx[j + 1] = x.derivatives()[at];
        dy[j + 1] = y.derivatives()[at];
        dpsi[j + 1] = angle.derivatives()[at];
      }
    } else {
      const double t = position(s);
      const auto fixed_t = chebyshev_sum<9>(derivatives_.data(), size_, t);
      for (std::size_t j = 0; j < 3; ++j) {
        const auto at = static_cast<Eigen::Index>(j);
        // s = lift_off + half (t + 1): what moves in s at fixed t is taken back.
        const double ds = -(lift_off_s_.derivatives()[at] + half_.derivatives()[at] * (t + 1.0));
        dx[j + 1] = fixed_t[3 * j] + dx[0] * ds;
        dy[j + 1] = fixed_t[3 * j + 1] + dy[0] * ds;
        dpsi[j + 1] = fixed_t[3 * j + 2] + dpsi[0] * ds;
      }
    }
    // s = r_m phi.
    const auto to_angles = [&](std::array<double, 4>& d) {
      d[by_neutral_radius] += d[0] * phi;
      d[by_material_angle] *= radius_m_;
    };
    to_angles(dx);
    to_angles(dy);
    to_angles(dpsi);
    const double rho = std::hypot(p.x, p.y), polar = std::atan2(p.y, p.x);
    PoseDerivatives result;
    result.value = {rho, polar, p.psi - right_angle - polar};
    for (std::size_t j = 0; j < 4; ++j) {
      result.rho[j] = (p.x * dx[j] + p.y * dy[j]) / rho;
      result.phi1[j] = (p.x * dy[j] - p.y * dx[j]) / (rho * rho);
      result.normal_rotation[j] = dpsi[j] - result.phi1[j];
    }
    return result;
  }

  RadialDisplacement displacement(double polar) const override {
    // Newton for the arc length at this polar angle; d(polar)/ds = sin(psi - polar)/rho.
    double s = radius_m_ * polar;
    Point p{};
    for (int step = 0; step < 12; ++step) {
      p = point(std::clamp(s, 0.0, right_angle * radius_m_));
      const double here = std::atan2(p.y, p.x), rho = std::hypot(p.x, p.y);
      const double correction = (polar - here) * rho / std::sin(p.psi - here);
      s += correction;
      if (std::abs(correction) < 1e-15 * radius_m_)
        break;
    }
    p = point(std::clamp(s, 0.0, right_angle * radius_m_));
    const double rho = std::hypot(p.x, p.y), across = p.psi - std::atan2(p.y, p.x);
    const double cotangent = std::cos(across) / std::sin(across), sine = std::sin(across);
    const double first = rho * cotangent;
    const double turn = p.curvature * rho / sine - 1.0; // d(psi - polar)/d(polar)
    return {rho - radius_m_, first, first * cotangent - rho * turn / (sine * sine)};
  }

private:
  using Number = Dual<3>;
  struct Point {
    double x, y, psi, curvature;
  };

  double position(double s) const { return (s - lift_off_s_.value()) / half_.value() - 1.0; }

  Point point(double s) const {
    if (s <= lift_off_s_.value()) {
      const double radius = radius_.value(), angle = s / radius;
      return {e_.value() + radius * std::cos(angle), radius * std::sin(angle), right_angle + angle,
              1.0 / radius};
    }
    const auto v = chebyshev_sum<3>(values_.data(), size_, std::min(position(s), 1.0));
    const double lift_y = radius_.value() * std::sin(arc_.value());
    return {v[0], v[1], v[2], 1.0 / radius_.value() + n_over_ei_ * (v[1] - lift_y)};
  }

  double radius_m_;
  int size_;
  Number arc_, e_, radius_, lift_off_s_, half_;
  double n_over_ei_ = 0.0, lift_off_polar_ = 0.0;
  std::vector<double> values_;      // series of x, y, psi over the free arc
  std::vector<double> derivatives_; // of (x, y, psi) by r_m, by u0, by the given number, at fixed t
};

Failure not_converged(const ElasticaProblem& problem, const std::string& what) {
  return {Status::not_converged,
          fmt::format("two_disc_exact (r_m {} mm, u0 {} mm, {} {}): {}", problem.neutral_radius_mm,
                      problem.u0_mm, problem.eccentricity_given ? "eccentricity_mm" : "lift-off angle in rad",
                      problem.given, what)};
}

} // namespace

MadeShape make_elastica(const WaveGenerator& generator, double radius) {
  const auto wrap = first_order_wrap(generator);
  if (!wrap)
    return wrap.failure();
  const double u0 = generator.max_radial_deformation_mm;
  const bool by_eccentricity = generator.eccentricity_mm.has_value();
  const ElasticaProblem problem{.neutral_radius_mm = radius,
                                .u0_mm = u0,
                                .eccentricity_given = by_eccentricity,
                                .given = by_eccentricity ? *generator.eccentricity_mm : wrap->wrap_angle_rad};
  // First order: kappa = 1/r - (u + u'')/r^2 and u + u'' = const + 2 k sin phi, so N/EI = -2 k/r^3.
  const double k = TwoDisc<double>(u0, wrap->wrap_angle_rad).k;
  const auto shot = shoot(problem, {.arc_rad = wrap->wrap_angle_rad,
                                    .n_over_ei_per_mm2 = -2.0 * k / (radius * radius * radius),
                                    .eccentricity_mm = wrap->eccentricity_mm});
  if (!shot)
    return shot.failure();

  const auto solution = collocate(problem, *shot);
  if (!solution)
    return not_converged(problem, "no smooth free arc was found");
  const double arc = solution->lift_off.arc_rad;
  // Two ways to the same numbers: CVODES + KINSOL, and the collocation. Errors of the shooting reach the arc
  // r_m/u0-fold.
  if (!(std::abs(arc - shot->arc_rad) < 1e-8 * radius / u0))
    return not_converged(problem,
                         fmt::format("shooting and collocation disagree on the lift-off arc: {} and {} rad",
                                     shot->arc_rad, arc));
  if (!(arc > 0.0))
    return Failure{
        Status::no_wrap,
        fmt::format(
            "two_disc_exact: the discs do not wrap the flexspline at e/u0 = {:.4f}: the lift-off angle "
            "{:.4f} degrees is not positive (first order wraps up to 5.279, the exact curve a little "
            "less as u0/r_m grows)",
            wrap->eccentricity_mm / u0, arc * 180.0 / pi)};
  auto elastica = std::make_shared<Elastica>(problem, *solution);
  if (auto failure = check_wrap_agreement(generator, *elastica->summary().wrap_angle_rad))
    return *failure;
  return std::shared_ptr<const CurveShape>(std::move(elastica));
}

} // namespace strainwave
