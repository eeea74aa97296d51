#include "strainwave/model/flexspline/tooth_outline.hpp"

#include <cmath>
#include <numbers>

namespace strainwave {

double tooth_half_angle(const Flexspline& f, double radius_mm) {
  const double alpha = f.pressure_angle_deg * std::numbers::pi / 180.0;
  const double sine = std::sin(alpha), cosine = std::cos(alpha);
  const double theta = (std::numbers::pi / 2.0 + 2.0 * f.profile_shift * std::tan(alpha)) / f.teeth;
  const double ratio = radius_mm / (0.5 * f.module_mm * f.teeth);
  const double root = std::sqrt(std::fmax(ratio * ratio - cosine * cosine, 0.0));
  const double s = (root - sine) / cosine;
  const double x = std::cos(s - theta) + s * cosine * std::sin(s - theta + alpha);
  const double y = -std::sin(s - theta) + s * cosine * std::cos(s - theta + alpha);
  return std::atan2(y, x);
}

} // namespace strainwave
