#include "strainwave/model/results/response_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

namespace strainwave {

namespace {

using Slopes = Eigen::RowVectorXd;

/// One load of one result with its derivatives.
struct LoadedCase {
  const LoadResult& load;
  const std::vector<ForwardGradient::Phase>& phases;

  std::size_t phase_of_peak() const {
    std::size_t p = 0;
    while (p + 1 < load.phases.size() && load.phases[p].phase != load.peak_phase)
      ++p;
    return p;
  }
  /// The tooth whose force is the largest one.
  Slopes peak_force() const {
    const std::size_t p = phase_of_peak();
    const std::vector<double>& force = load.phases[p].force_n;
    const auto tooth = std::max_element(force.begin(), force.end()) - force.begin();
    return phases[p].force_n.row(tooth);
  }
  Slopes rotation(bool largest) const {
    const auto less = [](const PhaseForces& a, const PhaseForces& b) {
      return a.rotation_rad < b.rotation_rad;
    };
    const auto at = largest ? std::max_element(load.phases.begin(), load.phases.end(), less)
                            : std::min_element(load.phases.begin(), load.phases.end(), less);
    return phases[static_cast<std::size_t>(at - load.phases.begin())].rotation_rad.transpose();
  }
  /// Peak over mean of the teeth that carry: n peak / sum.
  Slopes force_ratio() const {
    const auto& at = phases[phase_of_peak()];
    double sum = 0.0;
    for (const double force : load.force_n)
      sum += force;
    const Slopes total = at.force_n.colwise().sum();
    return load.engaged_count / sum * (peak_force() - load.peak_force_n / sum * total);
  }
};

double force_ratio(const LoadResult& load) {
  double sum = 0.0;
  for (const double force : load.force_n)
    sum += force;
  return load.engaged_count > 0 ? load.peak_force_n * load.engaged_count / sum
                                : std::numeric_limits<double>::quiet_NaN();
}

/// The load that read_responses() takes for the worst.
class Worst {
public:
  Worst(std::span<const ForwardResult> results, std::span<const ForwardGradient> gradients)
      : results_(results), gradients_(gradients) {}

  Slopes of(bool largest, const std::function<double(const LoadResult&)>& value,
            const std::function<Slopes(const LoadedCase&)>& slopes) const {
    double found = std::numeric_limits<double>::quiet_NaN();
    Slopes result = Slopes::Constant(gradients_.front().min_backlash_um.size(), found);
    for (std::size_t k = 0; k < results_.size(); ++k) {
      for (std::size_t c = 0; c < results_[k].load.size(); ++c) {
        const LoadResult& load = results_[k].load[c];
        const double here = value(load);
        if (!(std::isnan(found) || (largest ? here > found : here < found)) || std::isnan(here))
          continue;
        found = here;
        result = slopes({load, gradients_[k].load[c]});
      }
    }
    return result;
  }

private:
  std::span<const ForwardResult> results_;
  std::span<const ForwardGradient> gradients_;
};

double largest_rotation(const LoadResult& load) {
  double rotation = load.rotation_rad;
  for (const PhaseForces& phase : load.phases)
    rotation = std::max(rotation, phase.rotation_rad);
  return rotation;
}

/// By name; a name that is missing has no derivative.
std::map<std::string_view, Slopes> slopes_by_name(std::span<const ForwardResult> results,
                                                  std::span<const ForwardGradient> gradients) {
  constexpr double arcsec = std::numbers::pi / (180.0 * 3600.0);
  const Worst worst(results, gradients);
  const ForwardResult& first = results.front();
  const ForwardGradient& gradient = gradients.front();
  std::map<std::string_view, Slopes> slopes;
  const auto at_peak = [](Eigen::VectorXd ForwardGradient::Phase::*member) {
    return
        [member](const LoadedCase& c) -> Slopes { return (c.phases[c.phase_of_peak()].*member).transpose(); };
  };
  slopes["peak_force_n"] = worst.of(
      true, [](const LoadResult& l) { return l.peak_force_n; },
      [](const LoadedCase& c) { return c.peak_force(); });
  slopes["force_ratio"] = worst.of(true, force_ratio, [](const LoadedCase& c) { return c.force_ratio(); });
  slopes["engaged_count"] = Slopes::Zero(gradient.min_backlash_um.size());
  slopes["rotation_rad"] =
      worst.of(true, largest_rotation, [](const LoadedCase& c) { return c.rotation(true); });
  slopes["torque_nm"] = worst.of(
      false, [](const LoadResult& l) { return l.torque_nm; }, at_peak(&ForwardGradient::Phase::torque_nm));
  slopes["tangent_stiffness_nm_per_rad"] = worst.of(
      false, [](const LoadResult& l) { return l.tangent_stiffness_nm_per_rad; },
      at_peak(&ForwardGradient::Phase::tangent_nm_per_rad));
  slopes["transmission_error_arcsec"] = worst.of(
      true,
      [](const LoadResult& l) {
        return l.transmission_error_arcsec.value_or(std::numeric_limits<double>::quiet_NaN());
      },
      [=](const LoadedCase& c) -> Slopes { return (c.rotation(true) - c.rotation(false)) / arcsec; });
  if (first.fidelity != Fidelity::linear)
    slopes["disc_force_n"] = worst.of(
        true, [](const LoadResult& l) { return l.disc_force_n; },
        at_peak(&ForwardGradient::Phase::disc_force_n));
  slopes["peak_pressure_mpa"] = worst.of(
      true, [](const LoadResult& l) { return l.peak_pressure.mpa; },
      [](const LoadedCase& c) -> Slopes {
        const auto at = std::max_element(c.phases.begin(), c.phases.end(), [](const auto& a, const auto& b) {
          return a.largest_pressure_mpa < b.largest_pressure_mpa;
        });
        return at->peak_pressure_mpa.transpose();
      });
  slopes["min_backlash_um"] = gradient.min_backlash_um.transpose();
  const bool interferes = first.backlash && (first.backlash->assembled ? first.backlash->assembled->min_um
                                                                       : first.backlash->min_um) < 0.0;
  slopes["interference_um"] = interferes ? Slopes(-gradient.min_backlash_um.transpose())
                                         : Slopes(Slopes::Zero(gradient.min_backlash_um.size()));
  slopes["rim_strain"] = gradient.rim_strain.transpose();
  slopes["assembly_force_n"] = gradient.assembly_force_n.transpose();
  if (first.stiffness) {
    const StiffnessResult& s = *first.stiffness;
    const Slopes wind_up = (gradient.rated_rotation_rad - gradient.take_up_rad).transpose();
    slopes["take_up_rad"] = gradient.take_up_rad.transpose();
    slopes["wind_up_rad"] = wind_up;
    slopes["secant_nm_per_rad"] = -s.secant_nm_per_rad / s.wind_up_rad * wind_up;
    if (std::isfinite(s.lost_motion_arcmin))
      slopes["lost_motion_arcmin"] = 2.0 / (60.0 * arcsec) * gradient.small_rotation_rad.transpose();
  }
  return slopes;
}

} // namespace

std::vector<double> read_response_gradient(std::span<const ForwardResult> results,
                                           std::span<const ForwardGradient> gradients) {
  const auto slopes = slopes_by_name(results, gradients);
  const auto count = static_cast<std::size_t>(gradients.front().min_backlash_um.size());
  std::vector<double> all;
  for (const Response& response : gear_responses()) {
    if (const auto found = slopes.find(response.name); found != slopes.end())
      all.insert(all.end(), found->second.begin(), found->second.end());
    else
      all.insert(all.end(), count, std::numeric_limits<double>::quiet_NaN());
  }
  return all;
}

} // namespace strainwave
