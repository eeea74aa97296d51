#include "strainwave/model/meshing/pressure_angle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strainwave {

namespace {

double involute(double angle) {
  return std::tan(angle) - angle;
}
double angle_at(double base, double radius) {
  return std::acos(std::min(1.0, base / radius));
}

} // namespace

double contact_pressure_angle(const Gear& gear, const Pose& pose, const ToothBacklash& contact) {
  const Flexspline& fs = gear.flexspline;
  const double alpha0 = fs.pressure_angle_deg * std::numbers::pi / 180.0;
  if (contact.place == ContactPlace::flexspline_tip || contact.place == ContactPlace::flexspline_root ||
      contact.place == ContactPlace::flexspline_kink) {
    const double base = 0.5 * fs.module_mm * gear.circular_spline.teeth * std::cos(alpha0);
    return angle_at(base, contact.contact_radius_mm);
  }
  const double base = 0.5 * fs.module_mm * fs.teeth * std::cos(alpha0);
  const double radius = fs.root_radius_mm + contact.flank_height * (fs.tip_radius_mm - fs.root_radius_mm);
  const double alpha = angle_at(base, radius);
  const double beta = (0.5 * std::numbers::pi + 2.0 * fs.profile_shift * std::tan(alpha0)) / fs.teeth +
                      involute(alpha0) - involute(alpha);
  // The point in the frame of the tooth's neutral point, then seen from the gear's axis.
  const double along = radius * std::cos(beta) - fs.neutral_radius_mm;
  const double across = radius * std::sin(beta);
  const double c = std::cos(pose.normal_rotation_rad);
  const double s = std::sin(pose.normal_rotation_rad);
  const double from_pose = std::atan2(s * along + c * across, pose.rho_mm + c * along - s * across);
  return alpha - (pose.normal_rotation_rad + beta - from_pose);
}

} // namespace strainwave
