#include "strainwave/model/contact/load_tangent.hpp"

namespace strainwave {

namespace {

/// Steps of central differences: the gap is a distance of some 14 mm, its curvature 1/14 per mm. 1e-5 mm
/// leaves 1e-10 of the normals and 1e-9 of their turning; 1e-3 mm of the discs 1e-6 of the second difference.
constexpr double wall_step_mm = 1e-5;
constexpr double disc_step_mm = 1e-3;

struct Gaps {
  Eigen::VectorXd gap;
  Eigen::MatrixX2d normal;
};

Gaps gaps_at(const WaveGeneratorSurface& surface, const std::vector<WallStation>& stations,
             const Eigen::MatrixX2d& displacement) {
  const auto m = static_cast<Eigen::Index>(stations.size());
  Gaps result{Eigen::VectorXd(m), Eigen::MatrixX2d(m, 2)};
  for (Eigen::Index i = 0; i < m; ++i) {
    const WallStation& s = stations[static_cast<std::size_t>(i)];
    const WallGap g = surface.gap(s.phi_rad, s.z_mm, displacement(i, 0), displacement(i, 1));
    result.gap(i) = g.gap_mm;
    result.normal.row(i) << g.radial, g.circumferential;
  }
  return result;
}

/// Changes of the wall's gaps with the discs, the wall standing still: rows of the three modes.
Eigen::MatrixXd gap_modes(const std::vector<WallStation>& stations, const Eigen::MatrixX2d& displacement,
                          const ChangedSurface& changed) {
  const auto value = [&](double e, double r) { return gaps_at(changed({e, r}), stations, displacement).gap; };
  const double h = disc_step_mm;
  const Eigen::VectorXd here = value(0.0, 0.0), up = value(h, 0.0), down = value(-h, 0.0);
  Eigen::MatrixXd modes(here.size(), 3);
  modes.col(0) = (up - down) / (2.0 * h);
  modes.col(1) = (up - 2.0 * here + down) / (2.0 * h * h);
  modes.col(2) = (value(0.0, h) - value(0.0, -h)) / (2.0 * h);
  return modes;
}

} // namespace

LoadTangent tangent_at(const RingCompliance& ring, const WaveGeneratorSurface& surface,
                       const AssembledState& assembled, const LoadProblem& load, const ExactLoad& exact,
                       const ChangedSurface& changed) {
  const Eigen::Index n = load.point_count;
  const Eigen::Index m = assembled.force_n.size();
  LoadTangent result;
  result.state = exact.state;
  const Eigen::VectorXd& z = result.state.force;
  const Eigen::MatrixX2d u = ring.wall_displacement(assembled.stations, assembled.stations, exact.wall_force,
                                                    load.points, -z.head(n));
  const Gaps here = gaps_at(surface, assembled.stations, u);
  const Eigen::MatrixX2d& normal = here.normal;
  Eigen::MatrixX2d across(m, 2);
  across.col(0) = -normal.col(1);
  across.col(1) = normal.col(0);

  // the stations that carry, once more in the direction across their normals
  std::vector<WallStation> stations = assembled.stations;
  std::vector<Eigen::Index> loaded;
  for (Eigen::Index i = 0; i < m; ++i)
    if (z(n + i) > 0.0)
      loaded.push_back(i);
  const auto k = static_cast<Eigen::Index>(loaded.size());
  Eigen::MatrixX2d directions(m + k, 2);
  directions.topRows(m) = normal;
  directions.bottomRows(k) = across(loaded, Eigen::all);
  for (const Eigen::Index i : loaded)
    stations.push_back(assembled.stations[static_cast<std::size_t>(i)]);
  const Eigen::MatrixXd wall_wall = ring.wall_wall(stations, directions);
  const Eigen::MatrixXd wall_tooth = ring.wall_tooth(stations, directions, load.points);

  Eigen::MatrixXd plain(n + m, n + m);
  plain.topLeftCorner(n, n) = load.problem.m.topLeftCorner(n, n);
  plain.bottomLeftCorner(m, n) = -wall_tooth.topRows(m);
  plain.topRightCorner(n, m) = -wall_tooth.topRows(m).transpose();
  plain.bottomRightCorner(m, m) = wall_wall.topLeftCorner(m, m);

  const Gaps forth = gaps_at(surface, assembled.stations, u + wall_step_mm * across);
  const Gaps back = gaps_at(surface, assembled.stations, u - wall_step_mm * across);
  const Eigen::VectorXd curvature =
      ((forth.normal - back.normal).array() * across.array()).rowwise().sum() / (2.0 * wall_step_mm);

  // M' = M + Yᵀ (K⁻¹ − T)⁻¹ Y, Y: motion across the normals from all unknowns, T = tᵀ G t
  Eigen::MatrixXd y(k, n + m);
  y.leftCols(n) = -wall_tooth.bottomRows(k);
  y.rightCols(m) = wall_wall.bottomLeftCorner(k, m);
  Eigen::MatrixXd soft = -wall_wall.bottomRightCorner(k, k);
  bool turning = k > 0;
  for (Eigen::Index i = 0; i < k; ++i) {
    const double stiffness =
        z(n + loaded[static_cast<std::size_t>(i)]) * curvature(loaded[static_cast<std::size_t>(i)]);
    turning = turning && stiffness > 0.0;
    soft(i, i) += 1.0 / stiffness;
  }
  Eigen::MatrixXd answer = Eigen::MatrixXd::Zero(k, n + m); // (K⁻¹ − T)⁻¹ Y
  if (turning) {
    const Eigen::LLT<Eigen::MatrixXd> factor(soft);
    turning = factor.info() == Eigen::Success;
    if (turning)
      answer = factor.solve(y);
  }
  result.turning = turning;
  result.problem.m = plain;
  const Eigen::MatrixXd addition = y.transpose() * answer;
  result.problem.m += 0.5 * (addition + addition.transpose());

  // q such that the exact state solves it
  result.problem.r = load.problem.r;
  const Eigen::VectorXd moved = result.problem.m * z;
  result.problem.q.resize(n + m);
  result.problem.q.head(n) = load.problem.q.head(n) + (plain * z - moved).head(n);
  result.problem.q.tail(m) = here.gap - moved.tail(m);

  if (changed) {
    result.modes = Eigen::MatrixXd::Zero(n + m, 3);
    result.modes.bottomRows(m) = gap_modes(assembled.stations, u, changed);
    if (turning) {
      // The discs' motion turns the normals by ν; the forces p* ν across them move everything by G':
      // G' t = G t (K⁻¹ − T)⁻¹ K⁻¹, so K⁻¹ p* ν = ν/κ.
      const Gaps up = gaps_at(changed({disc_step_mm, 0.0}), assembled.stations, u);
      const Gaps down = gaps_at(changed({-disc_step_mm, 0.0}), assembled.stations, u);
      const Eigen::VectorXd turn =
          ((up.normal - down.normal).array() * across.array()).rowwise().sum() / (2.0 * disc_step_mm);
      result.modes.col(0) += answer.transpose() * turn(loaded).cwiseQuotient(curvature(loaded));
    }
  }
  return result;
}

LoadTangent linear_tangent(const AssembledState& assembled, const LoadProblem& load,
                           const ContactState& state, const ChangedSurface& changed) {
  LoadTangent result{load.problem, state, {}, false};
  const Eigen::Index n = load.point_count;
  const Eigen::Index m = load.problem.q.size() - n;
  if (changed && m > 0) {
    result.modes = Eigen::MatrixXd::Zero(n + m, 3);
    const Eigen::MatrixX2d rest = Eigen::MatrixX2d::Zero(m, 2);
    result.modes.bottomRows(m) = gap_modes(assembled.stations, rest, changed);
  }
  return result;
}

} // namespace strainwave
