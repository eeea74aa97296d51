// The answer of a contact state to small changes, against one dense linear system written out from the
// equations of contact_tangent.hpp, with weak and with strong geometric stiffness; and the surface's
// derivatives against differences.

#include "strainwave/model/contact/contact_tangent.hpp"
#include "strainwave/model/contact/wave_generator_surface.hpp"
#include "tests/model/kinematics/order_of_convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave::testing_support {
namespace {

constexpr int teeth = 3, stations = 4, columns = 2;

/// A symmetric positive definite compliance of all points, and changes of every kind.
struct Case {
  explicit Case(double stiffness_in) {
    std::srand(7);
    const int n = teeth + 2 * stations;
    const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n);
    g = 1e-4 * (a * a.transpose() + 0.5 * Eigen::MatrixXd::Identity(n, n));
    r = Eigen::VectorXd::Random(teeth).array() + 14.0;
    r(1) = -r(1); // a coast flank
    stiffness = Eigen::VectorXd::Random(stations).array().abs() * stiffness_in;
    change = {.wall_displacement = Eigen::MatrixXd::Random(2 * stations, columns),
              .wall_gap = Eigen::MatrixXd::Random(stations, columns),
              .wall_turn_force = 1e3 * Eigen::MatrixXd::Random(stations, columns),
              .tooth_gap = Eigen::MatrixXd::Random(teeth, columns),
              .torque = Eigen::RowVectorXd::Random(columns)};
  }
  ClosedCompliance compliance() const {
    return {.wall_wall = g.bottomRightCorner(2 * stations, 2 * stations),
            .wall_tooth = g.bottomLeftCorner(2 * stations, teeth),
            .tooth_tooth = g.topLeftCorner(teeth, teeth)};
  }
  /// Unknowns dF, dλ, f, dθ.
  Eigen::MatrixXd dense(bool torque) const {
    constexpr int n = teeth + 2 * stations + 1;
    const auto tt = g.topLeftCorner(teeth, teeth), wt = g.bottomLeftCorner(2 * stations, teeth),
               ww = g.bottomRightCorner(2 * stations, 2 * stations);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), b(n, columns);
    a.topLeftCorner(teeth, teeth) = tt;
    a.block(0, teeth, teeth, 2 * stations) = -wt.transpose();
    a.block(0, n - 1, teeth, 1) = -r;
    b.topRows(teeth) = -change.tooth_gap;
    a.block(teeth, 0, stations, teeth) = -wt.topRows(stations);
    a.block(teeth, teeth, stations, 2 * stations) = ww.topRows(stations);
    b.middleRows(teeth, stations) = -change.wall_gap - change.wall_displacement.topRows(stations);
    const Eigen::MatrixXd s = stiffness.asDiagonal();
    a.block(teeth + stations, 0, stations, teeth) = s * wt.bottomRows(stations);
    a.block(teeth + stations, teeth, stations, 2 * stations) = -s * ww.bottomRows(stations);
    a.block(teeth + stations, teeth + stations, stations, stations) +=
        Eigen::MatrixXd::Identity(stations, stations);
    b.middleRows(teeth + stations, stations) =
        change.wall_turn_force + s * change.wall_displacement.bottomRows(stations);
    if (torque) {
      a.block(n - 1, 0, 1, teeth) = r.transpose();
      b.bottomRows(1) = change.torque;
    } else {
      a(n - 1, n - 1) = 1.0;
      b.bottomRows(1).setZero();
    }
    return a.fullPivLu().solve(b);
  }
  Eigen::MatrixXd g;
  Eigen::VectorXd r, stiffness;
  StateChange change;
};

TEST(ContactTangent, SolvesTheEquationsAtWeakAndStrongGeometricStiffness) {
  for (const double stiffness : {0.0, 1.0, 1e5}) { // the last one does not contract
    for (const bool torque : {false, true}) {
      const Case c(stiffness);
      const StateAnswer answer =
          ContactTangent(c.compliance(), c.r, c.stiffness)
              .solve(c.change, torque ? ContactTangent::Held::torque : ContactTangent::Held::rotation);
      const Eigen::MatrixXd exact = c.dense(torque);
      Eigen::MatrixXd found(exact.rows(), columns);
      found << answer.tooth_force, answer.wall_normal, answer.wall_tangent, answer.rotation;
      EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-9 * exact.cwiseAbs().maxCoeff()) << stiffness;
    }
  }
}

TEST(WaveGeneratorSurface, DerivativesConvergeWithOrderTwo) {
  const auto surface = [](double de, double dr, double dtaper, bool linearised) {
    return WaveGeneratorSurface(WaveGeneratorSurface::Discs{.eccentricity_mm = 0.6 + de,
                                                            .neutral_disc_radius_mm = 13.606 + dr,
                                                            .linearised = linearised,
                                                            .taper_per_mm = 1e-3 + dtaper,
                                                            .middle_z_mm = 24.0},
                                13.8, 0.2);
  };
  const double z = 25.5, w = 0.1, v = -0.05;
  for (const bool linearised : {false, true}) {
    for (const double phi : {-0.7, 0.2, 2.9}) {
      const auto base = surface(0.0, 0.0, 0.0, linearised);
      const WallGap here = base.gap(phi, z, w, v);
      const auto slopes = base.disc_slopes(phi, z, w, v);
      const auto expect = [&](double slope, double step, auto&& value) {
        const OrderReport report = order_of_convergence(value, slope, step, 1e-14);
        EXPECT_TRUE(report.good) << report.text;
      };
      const auto turn = [&](const WallGap& there) {
        return std::atan2(here.radial * there.circumferential - here.circumferential * there.radial,
                          here.radial * there.radial + here.circumferential * there.circumferential);
      };
      expect(slopes.gap_by_eccentricity, 1e-2,
             [&](double x) { return surface(x, 0.0, 0.0, linearised).gap(phi, z, w, v).gap_mm; });
      expect(slopes.turn_by_eccentricity, 1e-2,
             [&](double x) { return turn(surface(x, 0.0, 0.0, linearised).gap(phi, z, w, v)); });
      expect(slopes.gap_by_radius, 1e-2,
             [&](double x) { return surface(0.0, x, 0.0, linearised).gap(phi, z, w, v).gap_mm; });
      expect(slopes.gap_by_taper, 1e-2,
             [&](double x) { return surface(0.0, 0.0, x, linearised).gap(phi, z, w, v).gap_mm; });
      expect(base.curvature(phi, z, w, v), 1e-2, [&](double x) {
        return turn(base.gap(phi, z, w - x * here.circumferential, v + x * here.radial));
      });
    }
  }
}

} // namespace
} // namespace strainwave::testing_support
