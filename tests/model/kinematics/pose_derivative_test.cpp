// Derivatives of the pose against central differences: the error must fall with the square of the step.

#include "tests/model/kinematics/curves.hpp"
#include "tests/model/kinematics/order_of_convergence.hpp"

#include <gtest/gtest.h>

#include <string>

namespace strainwave::testing_support {
namespace {

/// One number of the gear, its column, its scale and the factor from the file's unit to the column's.
struct Variable {
  std::string name;
  std::size_t column;
  double step;
  double per_unit;
  double& (*in)(Gear&);
};

double& u0(Gear& g) {
  return g.wave_generator.max_radial_deformation_mm;
}
double& rm(Gear& g) {
  return g.flexspline.neutral_radius_mm;
}
double& eccentricity(Gear& g) {
  return *g.wave_generator.eccentricity_mm;
}
double& wrap(Gear& g) {
  return *g.wave_generator.wrap_angle_deg;
}
double& force(Gear& g) {
  return *g.wave_generator.force_angle_deg;
}

void expect_order(const Gear& gear, const Variable& variable) {
  const NeutralCurve curve = curve_of(gear);
  for (const double phi : {0.1, 0.5, 1.0, 1.4, -0.7, 2.9}) {
    const PoseDerivatives at = curve.pose_derivatives(phi);
    const auto part = [&](double x, int which) {
      Gear moved = gear;
      variable.in(moved) += x;
      const Pose p = curve_of(moved).pose(phi);
      return which == 0 ? p.rho_mm : which == 1 ? p.phi1_rad : p.normal_rotation_rad;
    };
    const std::array<double, 4>* parts[] = {&at.rho, &at.phi1, &at.normal_rotation};
    for (int which = 0; which < 3; ++which) {
      const auto report = order_of_convergence([&](double x) { return part(x, which); },
                                               (*parts[which])[variable.column] * variable.per_unit,
                                               variable.step, which == 0 ? 1e-13 : 1e-14);
      EXPECT_TRUE(report.good) << variable.name << " phi " << phi << " part " << which << ": " << report.text;
    }
  }
}

TEST(PoseDerivatives, TwoDiscByEccentricity) {
  for (const auto shape : {WaveGeneratorShape::two_disc, WaveGeneratorShape::two_disc_exact}) {
    const Gear gear = seed_with(shape);
    expect_order(gear, {"u0", by_radial_deformation, 1e-3, 1.0, u0});
    expect_order(gear, {"r_m", by_neutral_radius, 2e-1, 1.0, rm});
    expect_order(gear, {"e", by_shape_number, 2e-3, 1.0, eccentricity});
  }
}

TEST(PoseDerivatives, TwoDiscByWrapAngle) {
  for (const auto shape : {WaveGeneratorShape::two_disc, WaveGeneratorShape::two_disc_exact}) {
    Gear gear = seed_with(shape);
    gear.wave_generator.eccentricity_mm.reset();
    gear.wave_generator.wrap_angle_deg = 40.0;
    expect_order(gear, {"u0", by_radial_deformation, 1e-2, 1.0, u0});
    expect_order(gear, {"r_m", by_neutral_radius, 2e-1, 1.0, rm});
    expect_order(gear, {"gamma", by_shape_number, 0.5, degree, wrap});
  }
}

TEST(PoseDerivatives, OtherShapes) {
  for (const auto shape :
       {WaveGeneratorShape::four_force, WaveGeneratorShape::ellipse, WaveGeneratorShape::cosine}) {
    const Gear gear = seed_with(shape);
    expect_order(gear, {"u0", by_radial_deformation, 1e-2, 1.0, u0});
    expect_order(gear, {"r_m", by_neutral_radius, 2e-1, 1.0, rm});
    if (shape == WaveGeneratorShape::four_force)
      expect_order(gear, {"beta", by_shape_number, 0.25, degree, force});
  }
}

TEST(PoseDerivatives, ByMaterialAngle) {
  for (const WaveGeneratorShape shape : shapes_without_file) {
    const NeutralCurve curve = curve_of(seed_with(shape));
    for (const double phi : {0.1, 0.4, 1.0, 1.4, -0.3, 2.9}) {
      const PoseDerivatives at = curve.pose_derivatives(phi);
      const std::array<double, 4>* parts[] = {&at.rho, &at.phi1, &at.normal_rotation};
      for (int which = 0; which < 3; ++which) {
        const auto report = order_of_convergence(
            [&](double x) {
              const Pose p = curve.pose(phi + x);
              return which == 0 ? p.rho_mm : which == 1 ? p.phi1_rad : p.normal_rotation_rad;
            },
            (*parts[which])[by_material_angle], 2e-2, which == 0 ? 1e-13 : 1e-14);
        EXPECT_TRUE(report.good) << static_cast<int>(shape) << " phi " << phi << " part " << which << ": "
                                 << report.text;
      }
    }
  }
}

TEST(PoseDerivatives, TheOrderCheckFindsAWrongEntry) {
  const auto cube = [](double x) { return std::pow(1.0 + x, 3.0); };
  EXPECT_TRUE(order_of_convergence(cube, 3.0, 1e-2, 1e-15).good);
  EXPECT_FALSE(order_of_convergence(cube, 3.0 * (1.0 + 1e-5), 1e-2, 1e-15).good);
}

} // namespace
} // namespace strainwave::testing_support
