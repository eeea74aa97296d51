#include "strainwave/model/tooth/gear_numbers.hpp"
#include "strainwave/model/tooth/prepared_pair.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace strainwave {
namespace {

struct Sample {
  double phi;
  ToothBacklash contact;
  double slope; // d backlash/d phi
};

class AlongPhi {
public:
  AlongPhi(const Gear& gear, const FlankPair& pair, const NeutralCurve& curve)
      : pair_(pair), curve_(curve), dual_(tooth_pair(gear_numbers<Dual<2>>(gear), gear.flexspline.teeth,
                                                     gear.circular_spline.teeth, pair.prepared().zeta)) {}

  Sample at(double phi, bool with_slope) const {
    using T = Dual<2>;
    const double ratio = pair_.prepared().teeth_ratio;
    if (!with_slope)
      return {phi, pair_.drive(curve_.pose(phi), phi * ratio), 0.0};
    const PoseDerivatives pose = curve_.pose_derivatives(phi);
    const ToothBacklash contact = pair_.drive(pose.value, phi * ratio);
    if (!contact.overlap)
      return {phi, contact, 0.0};
    const auto moving = [](double value, double by_phi) { return T(value, Eigen::Vector2d(by_phi, 0.0)); };
    const Placement<T> place =
        place_tooth(moving(pose.value.rho_mm, pose.rho[by_material_angle]),
                    moving(pose.value.phi1_rad, pose.phi1[by_material_angle]),
                    moving(pose.value.normal_rotation_rad, pose.normal_rotation[by_material_angle]),
                    T(pair_.prepared().neutral_radius), moving(phi * ratio, ratio));
    return {phi, contact, contact_derivatives(dual_, place, contact).backlash[0]};
  }

private:
  const FlankPair& pair_;
  const NeutralCurve& curve_;
  ToothPair<Dual<2>> dual_;
};

} // namespace

Outcome<LeastBacklash> least_backlash(const Gear& gear, const NeutralCurve& curve, double zeta) {
  const auto pair = FlankPair::make(gear, zeta);
  if (!pair)
    return pair.failure();
  const AlongPhi along(gear, *pair, curve);
  const Window window = window_of(gear);
  // Steps of half a pitch, at most 2.5 degrees: the backlash varies over tens of degrees.
  const double step = std::min(std::numbers::pi / gear.flexspline.teeth, 2.5 * std::numbers::pi / 180.0);
  const int intervals = std::max(2, static_cast<int>(std::ceil((window.hi - window.lo) / step)));
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(intervals) + 1);
  for (int i = 0; i <= intervals; ++i)
    samples.push_back(along.at(window.lo + (window.hi - window.lo) * i / intervals, false));
  const Sample* best = nullptr;
  const auto better = [](const Sample& a, const Sample* b) {
    return a.contact.overlap && (!b || a.contact.backlash_mm < b->contact.backlash_mm);
  };
  for (const Sample& s : samples)
    if (better(s, best))
      best = &s;
  if (!best)
    return Failure{Status::no_overlap,
                   fmt::format("at no material angle do the flanks share a radius: flexspline "
                               "tip_radius_mm {}, circular_spline.tip_radius_mm {}",
                               gear.flexspline.tip_radius_mm, gear.circular_spline.tip_radius_mm)};
  Sample found = *best;
  // Look beside every sample that is no higher than its neighbours: a falling then rising slope encloses a
  // minimum.
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!samples[i].contact.overlap)
      continue;
    const auto not_below = [&](std::size_t k) {
      return !samples[k].contact.overlap || samples[k].contact.backlash_mm >= samples[i].contact.backlash_mm;
    };
    if ((i > 0 && !not_below(i - 1)) || (i + 1 < samples.size() && !not_below(i + 1)))
      continue;
    Sample lo = along.at(samples[i > 0 ? i - 1 : i].phi, true),
           hi = along.at(samples[std::min(i + 1, samples.size() - 1)].phi, true);
    const Sample middle = along.at(samples[i].phi, true);
    if (!lo.contact.overlap || middle.slope < 0.0)
      lo = middle;
    if (!hi.contact.overlap || middle.slope > 0.0)
      hi = middle;
    if (!(lo.slope < 0.0 && hi.slope > 0.0))
      continue;
    std::uintmax_t evaluations = 100;
    const auto [left, right] = boost::math::tools::toms748_solve(
        [&](double phi) { return along.at(phi, true).slope; }, lo.phi, hi.phi, lo.slope, hi.slope,
        boost::math::tools::eps_tolerance<double>(50), evaluations);
    const Sample end = along.at(0.5 * (left + right), false);
    // Rounding of equal values must not decide the place: the root of the slope does.
    if (end.contact.overlap && end.contact.backlash_mm <= found.contact.backlash_mm + 1e-15)
      found = end;
  }
  return LeastBacklash{found.contact.backlash_mm, found.phi, found.contact.contact_radius_mm};
}

} // namespace strainwave
