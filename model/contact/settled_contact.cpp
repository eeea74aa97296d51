#include "strainwave/model/contact/settled_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strainwave {

namespace {

/// Components of the compliance of closed points: wall (all radial, then all circumferential) and teeth.
struct Components {
  Eigen::MatrixXd wall_wall, wall_tooth, tooth_tooth;
};

Components components_of(const RingCompliance& ring, const ClosedContact& closed) {
  const auto w = static_cast<Eigen::Index>(closed.stations.size());
  std::vector<WallStation> twice = closed.stations;
  twice.insert(twice.end(), closed.stations.begin(), closed.stations.end());
  Eigen::MatrixX2d axes = Eigen::MatrixX2d::Zero(2 * w, 2);
  axes.col(0).head(w).setOnes();
  axes.col(1).tail(w).setOnes();
  return {ring.wall_wall(twice, axes), ring.wall_tooth(twice, axes, closed.teeth),
          ring.tooth_tooth(closed.teeth)};
}

/// N: from forces along the normals to components.
Eigen::VectorXd spread(const Eigen::MatrixX2d& normal, const Eigen::VectorXd& along) {
  Eigen::VectorXd components(2 * along.size());
  components << normal.col(0).cwiseProduct(along), normal.col(1).cwiseProduct(along);
  return components;
}

Eigen::MatrixXd along_rows(const Eigen::MatrixX2d& normal, const Eigen::MatrixXd& components) {
  const Eigen::Index w = normal.rows();
  return normal.col(0).asDiagonal() * components.topRows(w) +
         normal.col(1).asDiagonal() * components.bottomRows(w);
}

/// The contact matrix of closed points, teeth first.
Eigen::MatrixXd contact_matrix(const Components& g, const Eigen::MatrixX2d& normal) {
  const Eigen::Index t = g.tooth_tooth.rows(), w = normal.rows();
  Eigen::MatrixXd m(t + w, t + w);
  m.topLeftCorner(t, t) = g.tooth_tooth;
  m.bottomLeftCorner(w, t) = -along_rows(normal, g.wall_tooth);
  m.topRightCorner(t, w) = m.bottomLeftCorner(w, t).transpose();
  m.bottomRightCorner(w, w) = along_rows(normal, along_rows(normal, g.wall_wall).transpose());
  return m;
}

} // namespace

SettledContact settle(const RingCompliance& ring, const WaveGeneratorSurface& surface,
                      const ClosedContact& closed, Control control, double torque) {
  constexpr int most_steps = 40;
  constexpr double tolerance = 1e-14; // mm, and rad of the normals
  const Eigen::Index t = closed.r.size(), w = closed.wall_force.size();
  const Components g = components_of(ring, closed);
  const Eigen::LLT<Eigen::MatrixXd> factor(contact_matrix(g, closed.normal));
  if (factor.info() != Eigen::Success)
    throw NotPositiveDefinite(0, 0.0);
  Eigen::VectorXd lever = Eigen::VectorXd::Zero(t + w);
  lever.head(t) = closed.r;
  const Eigen::VectorXd rate = factor.solve(lever);

  SettledContact s{.converged = false,
                   .normal = closed.normal,
                   .displacement = Eigen::MatrixX2d(w, 2),
                   .wall_force = closed.wall_force,
                   .tooth_force = closed.tooth_force,
                   .rotation = closed.rotation};
  double before = std::numeric_limits<double>::infinity();
  for (s.steps = 0; s.steps < most_steps; ++s.steps) {
    const Eigen::VectorXd force = spread(s.normal, s.wall_force);
    const Eigen::VectorXd u = g.wall_wall * force - g.wall_tooth * s.tooth_force;
    Eigen::VectorXd residual(t + w);
    residual.head(t) =
        closed.q + g.tooth_tooth * s.tooth_force - g.wall_tooth.transpose() * force - s.rotation * closed.r;
    Eigen::MatrixX2d normal(w, 2);
    for (Eigen::Index j = 0; j < w; ++j) {
      const WallStation& at = closed.stations[static_cast<std::size_t>(j)];
      const WallGap gap = surface.gap(at.phi_rad, at.z_mm, u(j), u(w + j));
      residual(t + j) = gap.gap_mm;
      normal(j, 0) = gap.radial;
      normal(j, 1) = gap.circumferential;
    }
    s.residual_mm = residual.size() > 0 ? residual.cwiseAbs().maxCoeff() : 0.0;
    const double turned = w > 0 ? (normal - s.normal).cwiseAbs().maxCoeff() : 0.0;
    const double change = std::max(s.residual_mm, turned);
    s.displacement << u.head(w), u.tail(w);
    const double largest_mm =
        (w > 0 ? g.wall_wall.diagonal().maxCoeff() : 0.0) * s.wall_force.cwiseAbs().sum() +
        (t > 0 ? g.tooth_tooth.diagonal().maxCoeff() : 0.0) * s.tooth_force.cwiseAbs().sum();
    const double rounding = std::max(1e-11, gap_rounding_mm(t + w, surface.inner_radius_mm(), largest_mm));
    if (change < tolerance || (change < rounding && change > 0.5 * before)) {
      s.converged = true;
      break;
    }
    if (!std::isfinite(change) || (s.steps > 3 && change > before))
      break;
    before = change;
    s.normal = normal;
    Eigen::VectorXd step = factor.solve(-residual);
    if (control == Control::torque && t > 0) {
      const double missing = torque - closed.r.dot(s.tooth_force + step.head(t));
      const double turn = missing / closed.r.dot(rate.head(t));
      step += turn * rate;
      s.rotation += turn;
    }
    s.tooth_force += step.head(t);
    s.wall_force += step.tail(w);
  }
  // Stiffness at the final normals, by repeated correction with the factor at hand.
  if (s.converged && t > 0) {
    const Eigen::MatrixXd m = contact_matrix(g, s.normal);
    Eigen::VectorXd x = rate;
    for (int k = 0; k < 8; ++k) {
      const Eigen::VectorXd correction = factor.solve(lever - m * x);
      x += correction;
      if (correction.cwiseAbs().maxCoeff() <= 1e-15 * x.cwiseAbs().maxCoeff())
        break;
    }
    s.stiffness = closed.r.dot(x.head(t));
  }
  return s;
}

} // namespace strainwave
