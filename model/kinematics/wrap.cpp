#include "strainwave/model/kinematics/wrap.hpp"

#include "strainwave/common/core/units.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strainwave {
namespace {

using units::degree;
constexpr double ratio_at_right_angle = 1.0 / (1.0 - 2.0 / std::numbers::pi);
constexpr double ratio_at_zero = 0.5 * std::numbers::pi / (0.5 * std::numbers::pi - 4.0 / std::numbers::pi);

Failure singular(const std::string& what) {
  return {Status::singular_wave_generator,
          fmt::format(
              "{}: towards 90 degrees the free arc of the flexspline shrinks to a kink and no finite shape "
              "exists; wrap angles up to {} degrees are computed",
              what, largest_wrap_rad / degree)};
}

Outcome<double> wrap_from_ratio(double eccentricity, double u0) {
  const double ratio = eccentricity / u0;
  if (!(ratio > ratio_at_right_angle && ratio < ratio_at_zero))
    return Failure{Status::no_wrap,
                   fmt::format("eccentricity_mm {} / max_radial_deformation_mm {} = {:.5g}: "
                               "the discs wrap the flexspline only for "
                               "{:.3f} < e/u0 < {:.3f}, here {:.4g} mm < e < {:.4g} mm",
                               eccentricity, u0, std::min(ratio, 1e300), ratio_at_right_angle, ratio_at_zero,
                               ratio_at_right_angle * u0, ratio_at_zero * u0)};
  const auto excess = [&](double gamma) { return eccentricity_ratio(gamma) - ratio; };
  const double at_zero = excess(0.0), at_end = excess(largest_wrap_rad);
  if (at_zero <= 0.0)
    return 0.0;
  if (at_end > 0.0)
    return singular(
        fmt::format("eccentricity_mm {} / max_radial_deformation_mm {} = {:.6f} asks for a wrap angle "
                    "beyond {} degrees",
                    eccentricity, u0, ratio, largest_wrap_rad / degree));
  std::uintmax_t evaluations = 100;
  const auto [lo, hi] =
      boost::math::tools::toms748_solve(excess, 0.0, largest_wrap_rad, at_zero, at_end,
                                        boost::math::tools::eps_tolerance<double>(52), evaluations);
  return 0.5 * (lo + hi);
}

} // namespace

std::optional<Failure> check_wrap_agreement(const WaveGenerator& generator, double computed_rad) {
  if (!generator.eccentricity_mm || !generator.wrap_angle_deg)
    return std::nullopt;
  if (std::abs(computed_rad / degree - *generator.wrap_angle_deg) <= wrap_agreement_deg)
    return std::nullopt;
  return Failure{
      Status::contradiction,
      fmt::format("wrap_angle_deg {} contradicts eccentricity_mm {}, which gives {:.4f} degrees: leave one "
                  "of them out",
                  *generator.wrap_angle_deg, *generator.eccentricity_mm, computed_rad / degree)};
}

Outcome<Wrap> first_order_wrap(const WaveGenerator& generator) {
  const double u0 = generator.max_radial_deformation_mm;
  if (generator.eccentricity_mm) {
    const auto gamma = wrap_from_ratio(*generator.eccentricity_mm, u0);
    if (!gamma)
      return gamma.failure();
    return Wrap{*gamma, *generator.eccentricity_mm};
  }
  if (generator.wrap_angle_deg) {
    const double gamma = *generator.wrap_angle_deg * degree;
    if (!(gamma >= 0.0) || gamma >= 0.5 * std::numbers::pi)
      return Failure{Status::no_wrap, fmt::format("wrap_angle_deg {} is outside 0 <= wrap angle < 90 degrees",
                                                  *generator.wrap_angle_deg)};
    if (gamma > largest_wrap_rad)
      return singular(fmt::format("wrap_angle_deg {}", *generator.wrap_angle_deg));
    return Wrap{gamma, u0 * eccentricity_ratio(gamma)};
  }
  return Failure{
      Status::contradiction,
      fmt::format("two discs need either wave_generator.eccentricity_mm, between {:.4g} and {:.4g} mm for "
                  "max_radial_deformation_mm {}, or wave_generator.wrap_angle_deg",
                  ratio_at_right_angle * u0, ratio_at_zero * u0, u0)};
}

} // namespace strainwave
