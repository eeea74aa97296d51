#include "strainwave/model/tooth/flank_slopes.hpp"

#include "strainwave/model/tooth/gear_numbers.hpp"
#include "strainwave/model/tooth/prepared_pair.hpp"

#include <fmt/format.h>

#include <cmath>

namespace strainwave {
namespace {

/// One slot is the place on the flank.
constexpr int slots = 12;
constexpr int at_once = slots - 1;
using T = Dual<slots>;

/// f(path, number) for all numbers of the flanks.
template <class S, class Function>
void for_each_flank_number(GearNumbers<S>& g, const Function& f) {
  for_each_tooth_number(g, [&](const char* path, S& number) { f(std::string(path), number); });
  for (auto* m : {&g.on_flexspline, &g.on_circular_spline}) {
    const std::string table =
        m == &g.on_flexspline ? "flank_modification.flexspline." : "flank_modification.circular_spline.";
    for_each_modification_number(*m, [&](const char* key, S& number) { f(table + key, number); });
    for (std::size_t k = 0; k < m->spline_um.size(); ++k)
      f(fmt::format("{}spline_um[{}]", table, k), m->spline_um[k]);
  }
}

/// α′ of pressure_angle.hpp (model/forward): the normal of the flank that is smooth at the contact, against
/// the circumference.
T pressure_angle(const ToothPair<T>& pair, const T& neutral_radius, const T& rho, const T& normal_rotation,
                 const ContactSpot& spot, const T& t, const T& contact_radius) {
  using std::atan2, std::cos, std::sin, std::sqrt;
  const bool edge = spot.place == ContactPlace::flexspline_tip ||
                    spot.place == ContactPlace::flexspline_root ||
                    spot.place == ContactPlace::flexspline_kink;
  if (edge) {
    const T base = pair.circular_spline.base;
    const T ratio = contact_radius / base;
    const T square = ratio * ratio - 1.0;
    return value_of(square) > 0.0 ? arctan(T(sqrt(square))) : T(0.0);
  }
  const Flank<T>& tooth = pair.flexspline;
  const T alpha = arctan(t);
  const T beta = T(tooth.sigma - t) + alpha;
  const T radius = tooth.radius_at_roll(t);
  const T along = T(radius * cos(beta)) - neutral_radius, across = radius * sin(beta);
  const T c = cos(normal_rotation), s = sin(normal_rotation);
  const T y = T(s * along) + T(c * across), x = rho + T(T(c * along) - T(s * across));
  const T from_pose = atan2(y, x);
  return T(alpha - T(normal_rotation + beta)) + from_pose;
}

} // namespace

bool is_flank_parameter(const Gear& gear, const std::string& path) {
  GearNumbers<double> numbers = gear_numbers<double>(gear);
  bool found = false;
  for_each_flank_number(numbers, [&](const std::string& known, double&) { found = found || known == path; });
  return found;
}

/// The flanks in numbers that carry at_once parameters each.
struct FlankSlopes::Passes {
  struct One {
    ToothPair<T> pair;
    T neutral_radius;
  };
  std::size_t parameters = 0;
  std::vector<One> passes;
};

FlankSlopes::FlankSlopes(const Gear& gear, std::span<const std::string> parameters, double zeta) {
  auto made = std::make_unique<Passes>();
  made->parameters = parameters.size();
  for (std::size_t first = 0; first == 0 || first < parameters.size(); first += at_once) {
    GearNumbers<T> numbers = gear_numbers<T>(gear);
    for_each_flank_number(numbers, [&](const std::string& path, T& number) {
      for (std::size_t j = first; j < std::min(parameters.size(), first + at_once); ++j) {
        if (parameters[j] != path)
          continue;
        number.derivatives()[static_cast<Eigen::Index>(j - first)] = 1.0;
        if (path.starts_with("flank_modification.flexspline"))
          numbers.on_flexspline.wanted = true;
        if (path.starts_with("flank_modification.circular_spline"))
          numbers.on_circular_spline.wanted = true;
      }
    });
    made->passes.push_back({tooth_pair(numbers, gear.flexspline.teeth, gear.circular_spline.teeth, zeta),
                            numbers.neutral_radius});
  }
  passes_ = std::move(made);
}

FlankSlopes::~FlankSlopes() = default;
FlankSlopes::FlankSlopes(FlankSlopes&&) noexcept = default;

ContactSlopes FlankSlopes::at(const PoseSlopes& pose, double space_angle_rad, const ContactSpot& spot) const {
  const auto count = static_cast<Eigen::Index>(passes_->parameters);
  ContactSlopes result;
  for (auto* slopes : {&result.gap, &result.radius, &result.height_slope, &result.pressure_angle})
    slopes->resize(count);
  const double side = spot.coast ? -1.0 : 1.0;
  Eigen::Index first = 0;
  for (const Passes::One& pass : passes_->passes) {
    const Eigen::Index now = std::min<Eigen::Index>(at_once, count - first);
    const auto moving = [&](double value, Eigen::Index line, double sign) {
      Eigen::Matrix<double, slots, 1> by = Eigen::Matrix<double, slots, 1>::Zero();
      by.head(now) = sign * pose.by.row(line).segment(first, now).transpose();
      return T(sign * value, by);
    };
    const T rho = moving(pose.value.rho_mm, 0, 1.0), phi1 = moving(pose.value.phi1_rad, 1, side),
            turn = moving(pose.value.normal_rotation_rad, 2, side);
    const Placement<T> place = place_tooth(rho, phi1, turn, pass.neutral_radius, T(side * space_angle_rad));
    const Flank<T>& tooth = pass.pair.flexspline;
    T t;
    if (spot.height)
      t = tooth.roll_at_height(T(*spot.height));
    else
      t = contact_roll(pass.pair, place, spot.place, spot.kink, spot.roll);
    const Gap<T> gap = flank_gap(pass.pair, place, t);
    const T height = tooth.height_at_roll(t);
    const T angle = pressure_angle(pass.pair, pass.neutral_radius, rho, turn, spot, t, gap.radius);
    result.gap_mm = gap.gap.value();
    result.radius_mm = gap.radius.value();
    result.height = height.value();
    result.pressure_angle_rad = angle.value();
    const bool inner = !spot.height && spot.place == ContactPlace::flank;
    Eigen::VectorXd dt = Eigen::VectorXd::Zero(now);
    if (inner)
      dt = gap.slope.derivatives().head(now) * (-1.0 / gap.slope.derivatives()[slots - 1]);
    const auto store = [&](const T& number, Eigen::VectorXd& slopes) {
      slopes.segment(first, now) = number.derivatives().head(now) + number.derivatives()[slots - 1] * dt;
    };
    result.gap.segment(first, now) = gap.gap.derivatives().head(now);
    store(gap.radius, result.radius);
    store(height, result.height_slope);
    store(angle, result.pressure_angle);
    first += now;
  }
  return result;
}

} // namespace strainwave
