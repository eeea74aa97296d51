#include "strainwave/model/tooth/backlash_gradient.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/tooth/gear_numbers.hpp"
#include "strainwave/model/tooth/prepared_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace strainwave {
namespace {

using units::pi;

/// f(path, number) for all numbers that this gear and curve have.
template <class T, class Function>
void for_each_number(GearNumbers<T>& g, const NeutralCurve& curve, const Function& f) {
  for_each_tooth_number(g, [&](const char* path, T& number) { f(std::string(path), number); });
  if (curve.shape() != WaveGeneratorShape::table)
    f(std::string("wave_generator.max_radial_deformation_mm"), g.u0);
  if (!curve.shape_number_path().empty())
    f(std::string(curve.shape_number_path()), g.shape_number);
  for (auto* m : {&g.on_flexspline, &g.on_circular_spline}) {
    const std::string table =
        m == &g.on_flexspline ? "flank_modification.flexspline." : "flank_modification.circular_spline.";
    for_each_modification_number(*m, [&](const char* key, T& number) { f(table + key, number); });
    for (std::size_t k = 0; k < m->spline_um.size(); ++k)
      f(fmt::format("{}spline_um[{}]", table, k), m->spline_um[k]);
  }
}

/// Positions of the asked paths in backlash_parameters().
std::vector<std::size_t> positions(const Gear& gear, const NeutralCurve& curve,
                                   std::span<const std::string> paths) {
  const std::vector<std::string> known = backlash_parameters(gear, curve);
  std::vector<std::size_t> list;
  for (const std::string& path : paths) {
    const auto at = std::find(known.begin(), known.end(), path);
    if (at == known.end())
      throw std::invalid_argument(
          fmt::format("the backlash of this gear has no derivative with respect to '{}'", path));
    list.push_back(static_cast<std::size_t>(at - known.begin()));
  }
  return list;
}

/// One pass: derivatives with respect to at most M - 1 parameters, columns [first, first + wanted.size()).
template <int M>
void pass(const Gear& gear, const NeutralCurve& curve, const Backlash& at,
          std::span<const std::size_t> wanted, std::size_t first, BacklashGradient& result) {
  using T = Dual<M>;
  GearNumbers<T> numbers = gear_numbers<T>(gear);
  std::size_t position = 0;
  for_each_number(numbers, curve, [&](const std::string& path, T& number) {
    for (std::size_t j = 0; j < wanted.size(); ++j)
      if (wanted[j] == position) {
        number.derivatives()[static_cast<Eigen::Index>(j)] = 1.0;
        if (path.starts_with("flank_modification.flexspline"))
          numbers.on_flexspline.wanted = true;
        if (path.starts_with("flank_modification.circular_spline"))
          numbers.on_circular_spline.wanted = true;
      }
    ++position;
  });
  const ToothPair<T> pair = tooth_pair(numbers, gear.flexspline.teeth, gear.circular_spline.teeth, at.zeta);
  const bool angle = curve.shape_number_path().ends_with("_deg");
  const auto by_rm = numbers.neutral_radius.derivatives();
  const auto by_u0 = numbers.u0.derivatives();
  const Eigen::Matrix<double, M, 1> by_shape =
      numbers.shape_number.derivatives() * (angle ? pi / 180.0 : 1.0);
  const auto moving = [&](double value, const std::array<double, 4>& by) {
    return T(value, by_rm * by[by_neutral_radius] + by_u0 * by[by_radial_deformation] +
                        by_shape * by[by_shape_number]);
  };
  const double ratio = static_cast<double>(gear.flexspline.teeth) / gear.circular_spline.teeth;
  const auto store = [&](const ContactDerivatives<M - 1>& d, std::size_t row, std::vector<double>& gap,
                         std::vector<double>& radius) {
    for (std::size_t j = 0; j < wanted.size(); ++j) {
      gap[row + first + j] = d.backlash[static_cast<Eigen::Index>(j)];
      radius[row + first + j] = d.radius[static_cast<Eigen::Index>(j)];
    }
  };
  for (std::size_t k = 0; k < at.tooth.size(); ++k) {
    const double folded = at.phi_rad[k] - at.lobe[k] * pi;
    const PoseDerivatives pose = curve.pose_derivatives(folded);
    Placement<T> place =
        place_tooth(moving(pose.value.rho_mm, pose.rho), moving(pose.value.phi1_rad, pose.phi1),
                    moving(pose.value.normal_rotation_rad, pose.normal_rotation), numbers.neutral_radius,
                    T(folded * ratio));
    const std::size_t row = k * result.parameters;
    if (at.drive[k].overlap)
      store(contact_derivatives(pair, place, at.drive[k]), row, result.drive_mm, result.drive_radius_mm);
    // The mirror image of a placement.
    place.b = T(-place.b);
    place.tau = T(-place.tau);
    if (at.coast[k].overlap)
      store(contact_derivatives(pair, place, at.coast[k]), row, result.coast_mm, result.coast_radius_mm);
  }
}

} // namespace

std::vector<std::string> backlash_parameters(const Gear& gear, const NeutralCurve& curve) {
  GearNumbers<double> numbers = gear_numbers<double>(gear);
  std::vector<std::string> paths;
  for_each_number(numbers, curve, [&](const std::string& path, double&) { paths.push_back(path); });
  return paths;
}

BacklashGradient backlash_gradient(const Gear& gear, const NeutralCurve& curve, const Backlash& at,
                                   std::span<const std::string> parameters) {
  const std::vector<std::size_t> wanted = positions(gear, curve, parameters);
  BacklashGradient result;
  result.parameters = parameters.size();
  for (auto* list : {&result.drive_mm, &result.drive_radius_mm, &result.coast_mm, &result.coast_radius_mm})
    list->assign(at.tooth.size() * parameters.size(), 0.0);
  // One slot of each pass is the place on the flank.
  for (std::size_t first = 0; first < wanted.size();) {
    const std::size_t left = wanted.size() - first;
    const std::size_t now = std::min<std::size_t>(left, left <= 7 ? 7 : left <= 11 ? 11 : 15);
    const std::span<const std::size_t> some(wanted.data() + first, now);
    if (now <= 7)
      pass<8>(gear, curve, at, some, first, result);
    else if (now <= 11)
      pass<12>(gear, curve, at, some, first, result);
    else
      pass<16>(gear, curve, at, some, first, result);
    first += now;
  }
  return result;
}

} // namespace strainwave
