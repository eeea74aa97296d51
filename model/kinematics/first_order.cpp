// The first-order shapes and the rigid cams: two_disc, four_force, ellipse, cosine, table.

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/kinematics/polar_curve.hpp"
#include "strainwave/model/kinematics/table.hpp"
#include "strainwave/model/kinematics/wrap.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace strainwave {
namespace {

using units::pi;
using units::right_angle;
using Number = CurveNumber;

/// A shape that does not depend on the parameters, seen as one that does.
template <class Shape>
struct Constant {
  Shape shape;
  Displacement<Number> operator()(double phi) const {
    const Displacement<double> u = shape(phi);
    return {Number(u.u), Number(u.first), Number(u.second)};
  }
};

template <class Shape, class ShapeNumber>
MadeShape finish(double radius, Shape shape, ShapeNumber dual, std::vector<double> breaks,
                 CurveSummary summary = {}) {
  return std::shared_ptr<const CurveShape>(std::make_shared<PolarCurve<Shape, ShapeNumber>>(
      radius, std::move(shape), std::move(dual), std::move(breaks), std::move(summary)));
}

MadeShape make_two_disc(const WaveGenerator& generator, double radius) {
  const auto wrap = first_order_wrap(generator);
  if (!wrap)
    return wrap.failure();
  if (auto failure = check_wrap_agreement(generator, wrap->wrap_angle_rad))
    return *failure;
  const double u0 = generator.max_radial_deformation_mm, gamma = wrap->wrap_angle_rad;
  Number gamma_dual(gamma, 3, 2);
  const Number u0_dual(u0, 3, 1);
  if (generator.eccentricity_mm) {
    // gamma solves F(gamma) = e/u0: one Newton step in dual numbers carries the derivatives.
    const double slope = eccentricity_ratio(gamma_dual).derivatives()[2];
    const Number ratio = Number(wrap->eccentricity_mm, 3, 2) / u0_dual;
    gamma_dual = Number(gamma, ratio.derivatives() / slope);
  }
  return finish(radius, TwoDisc<double>(u0, gamma), TwoDisc<Number>(u0_dual, gamma_dual), {gamma},
                {.wrap_angle_rad = gamma,
                 .lift_off_arc_rad = {},
                 .n_over_ei_per_mm2 = {},
                 .eccentricity_mm = wrap->eccentricity_mm,
                 .disc_radius_mm = radius + u0 - wrap->eccentricity_mm});
}

MadeShape make_four_force(const WaveGenerator& generator, double radius) {
  if (!generator.force_angle_deg)
    return Failure{Status::contradiction,
                   "four forces need wave_generator.force_angle_deg, from 0 to below 90 degrees"};
  const double beta_deg = *generator.force_angle_deg, beta = beta_deg * pi / 180.0;
  if (!(beta >= 0.0) || !(beta <= right_angle))
    return Failure{Status::contradiction,
                   fmt::format("force_angle_deg {} is outside 0 to 90 degrees", beta_deg)};
  const double u0 = generator.max_radial_deformation_mm;
  const FourForce<double> shape(u0, beta);
  // The factor u0/(A - 4/pi) multiplies every displacement; past the pole its sign turns and the major axis
  // is pulled in.
  const double pole_distance = shape.a - 4.0 / pi;
  if (std::abs(pole_distance) < 0.01)
    return Failure{
        Status::singular_wave_generator,
        fmt::format(
            "force_angle_deg {}: four forces there do not move the major axis (A = {:.5f} against 4/pi "
            "= {:.5f}, pole at 44.3 degrees), so no finite force gives max_radial_deformation_mm {}",
            beta_deg, shape.a, 4.0 / pi, u0)};
  return finish(radius, shape, FourForce<Number>(Number(u0, 3, 1), Number(beta, 3, 2)), {beta});
}

/// Minor semi-axis of the ellipse with semi-axis a and perimeter 4 a E(k) = 2 pi r_m, k^2 = 1 - (b/a)^2.
Number minor_semi_axis(double radius, double a) {
  double b = radius - (a - radius);
  double by_b = 1.0, by_a = 1.0;
  for (int step = 0; step < 30; ++step) {
    const double k_squared = (a - b) * (a + b) / (a * a), k = std::sqrt(k_squared);
    const double first_kind = std::comp_ellint_1(k), second_kind = std::comp_ellint_2(k);
    const double by_k_squared = (second_kind - first_kind) / (2.0 * k_squared); // dE/d(k^2)
    by_b = 4.0 * a * by_k_squared * (-2.0 * b / (a * a));
    by_a = 4.0 * second_kind + 4.0 * a * by_k_squared * (2.0 * b * b / (a * a * a));
    const double correction = (2.0 * pi * radius - 4.0 * a * second_kind) / by_b;
    b += correction;
    if (std::abs(correction) < 1e-15 * radius)
      break;
  }
  // P(a, b) = 2 pi r_m with a = r_m + u0.
  return Number(b, Eigen::Vector3d((2.0 * pi - by_a) / by_b, -by_a / by_b, 0.0));
}

} // namespace

MadeShape make_polar_curve(const WaveGenerator& generator, double radius) {
  const double u0 = generator.max_radial_deformation_mm;
  const Number u0_dual(u0, 3, 1);
  switch (generator.shape) {
  case WaveGeneratorShape::two_disc:
    return make_two_disc(generator, radius);
  case WaveGeneratorShape::four_force:
    return make_four_force(generator, radius);
  case WaveGeneratorShape::cosine:
    return finish(radius, Cosine<double>(u0), Cosine<Number>(u0_dual), {});
  case WaveGeneratorShape::ellipse: {
    const Number minor = minor_semi_axis(radius, radius + u0);
    return finish(radius, Ellipse<double>(radius, u0, minor.value()),
                  Ellipse<Number>(Number(radius, 3, 0), u0_dual, minor), {});
  }
  case WaveGeneratorShape::table: {
    ShapeTable table = ShapeTable::read(generator.table_file);
    for (double phi : table.angles_rad())
      if (!(std::abs(table(phi).u) < 0.2 * radius))
        return Failure{
            Status::contradiction,
            fmt::format("{}: displacement {} mm at {} degrees is more than a fifth of neutral_radius_mm {}",
                        generator.table_file, table(phi).u, phi * 180.0 / pi, radius)};
    const std::vector<double> breaks = table.angles_rad();
    return finish(radius, table, Constant<ShapeTable>{table}, breaks);
  }
  case WaveGeneratorShape::two_disc_exact:
    break;
  }
  throw std::logic_error("make_polar_curve: not a polar shape");
}

} // namespace strainwave
