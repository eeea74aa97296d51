#include "strainwave/model/results/response.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace strainwave {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Over loads: how one of them is read, and whether the largest or the least of them counts.
double worst(std::span<const ForwardResult> results, bool largest,
             const std::function<double(const LoadResult&)>& read) {
  double found = none;
  for (const ForwardResult& result : results) {
    for (const LoadResult& load : result.load) {
      const double value = read(load);
      if (std::isnan(found) || (largest ? value > found : value < found))
        found = value;
    }
  }
  return found;
}

/// Peak over mean of the teeth that carry load: 1 when all carry the same.
double force_ratio(const LoadResult& load) {
  double sum = 0.0;
  for (const double force : load.force_n)
    sum += force;
  return load.engaged_count > 0 ? load.peak_force_n * load.engaged_count / sum : none;
}

/// Over the phases of one pitch.
double largest_rotation(const LoadResult& load) {
  double rotation = load.rotation_rad;
  for (const PhaseForces& phase : load.phases)
    rotation = std::max(rotation, phase.rotation_rad);
  return rotation;
}

/// Of the nearer one of the two teeth on either side of the zone around the tooth with the largest force.
double edge_backlash(const LoadResult& load) {
  const std::vector<double>& force = load.force_n;
  const auto peak = std::max_element(force.begin(), force.end());
  if (peak == force.end() || !(*peak > 0.0))
    return none;
  auto first = peak, last = peak;
  while (first != force.begin() && *(first - 1) > 0.0)
    --first;
  while (last + 1 != force.end() && *(last + 1) > 0.0)
    ++last;
  const auto gap = [&](auto tooth) {
    return load.loaded_backlash_um[static_cast<std::size_t>(tooth - force.begin())];
  };
  double nearer = std::numeric_limits<double>::infinity();
  if (first != force.begin())
    nearer = gap(first - 1);
  if (last + 1 != force.end())
    nearer = std::min(nearer, gap(last + 1));
  return std::isfinite(nearer) ? nearer : none;
}

constexpr bool largest = true;
constexpr bool least = false;

struct Row {
  Response response;
  double (*read)(std::span<const ForwardResult>);
};

template <double LoadResult::*Member, bool Largest>
double of_load(std::span<const ForwardResult> results) {
  return worst(results, Largest, [](const LoadResult& load) { return load.*Member; });
}

template <double StiffnessResult::*Member>
double of_stiffness(std::span<const ForwardResult> results) {
  const auto& stiffness = results.front().stiffness;
  return stiffness ? (*stiffness).*Member : none;
}

/// Of the gaps in use.
double least_backlash(std::span<const ForwardResult> results) {
  const auto& backlash = results.front().backlash;
  if (!backlash)
    return none;
  return backlash->assembled ? backlash->assembled->min_um : backlash->min_um;
}

const std::array rows{
    Row{{"peak_force_n", "N", "largest meshing force of a tooth"},
        of_load<&LoadResult::peak_force_n, largest>},
    Row{{"peak_pressure_mpa", "MPa", "largest contact pressure of a flank"},
        [](std::span<const ForwardResult> r) {
          return worst(r, largest, [](const LoadResult& load) { return load.peak_pressure.mpa; });
        }},
    Row{{"force_ratio", "", "largest meshing force over the mean of the teeth that carry load"},
        [](std::span<const ForwardResult> r) { return worst(r, largest, force_ratio); }},
    Row{{"engaged_count", "", "teeth of one lobe that carry load"},
        [](std::span<const ForwardResult> r) {
          return worst(r, least,
                       [](const LoadResult& load) { return static_cast<double>(load.engaged_count); });
        }},
    Row{{"rotation_rad", "rad", "largest rotation of the circular spline under load, take-up included"},
        [](std::span<const ForwardResult> r) { return worst(r, largest, largest_rotation); }},
    Row{{"torque_nm", "N·m", "torque on the circular spline"}, of_load<&LoadResult::torque_nm, least>},
    Row{{"min_backlash_um", "µm",
         "least initial backlash over continuous φ (assembled gaps: and over the face); negative: "
         "interference"},
        least_backlash},
    Row{{"interference_um", "µm", "overlap of the flanks before any load; 0 where there is none"},
        [](std::span<const ForwardResult> r) {
          const double b = least_backlash(r);
          return std::isnan(b) ? none : std::max(0.0, -b);
        }},
    Row{{"edge_backlash_um", "µm", "loaded backlash of the nearest tooth beside the zone that carries"},
        [](std::span<const ForwardResult> r) { return worst(r, least, edge_backlash); }},
    Row{{"secant_nm_per_rad", "N·m/rad", "torsional stiffness: rated torque over wind-up"},
        of_stiffness<&StiffnessResult::secant_nm_per_rad>},
    Row{{"tangent_stiffness_nm_per_rad", "N·m/rad", "slope of torque over rotation under load"},
        of_load<&LoadResult::tangent_stiffness_nm_per_rad, least>},
    Row{{"wind_up_rad", "rad", "rotation at rated torque after the first contact"},
        of_stiffness<&StiffnessResult::wind_up_rad>},
    Row{{"take_up_rad", "rad", "rotation to the first contact"}, of_stiffness<&StiffnessResult::take_up_rad>},
    Row{{"lost_motion_arcmin", "arcmin", "rotation between ±4 % of the rated torque"},
        of_stiffness<&StiffnessResult::lost_motion_arcmin>},
    Row{{"transmission_error_arcsec", "arcsec", "rotation at constant torque over one pitch, peak to peak"},
        [](std::span<const ForwardResult> r) {
          return worst(r, largest,
                       [](const LoadResult& load) { return load.transmission_error_arcsec.value_or(none); });
        }},
    Row{{"disc_force_n", "N", "resultant on one disc along the major axis under load"},
        [](std::span<const ForwardResult> r) {
          return r.front().fidelity == Fidelity::linear ? none
                                                        : of_load<&LoadResult::disc_force_n, largest>(r);
        }},
    Row{{"rim_strain", "", "largest bending strain of the rim by the wave generator"},
        [](std::span<const ForwardResult> r) {
          return r.front().wave_generator ? r.front().wave_generator->rim_strain : none;
        }},
    Row{{"assembly_force_n", "N", "resultant on one disc along the major axis, assembled, without load"},
        [](std::span<const ForwardResult> r) {
          return r.front().assembly ? r.front().assembly->contact_force_n : none;
        }},
};

} // namespace

std::span<const Response> gear_responses() {
  static const auto responses = [] {
    std::vector<Response> all;
    for (const Row& row : rows)
      all.push_back(row.response);
    return all;
  }();
  return responses;
}

std::span<const std::string_view> gear_response_names() {
  static const auto names = [] {
    std::vector<std::string_view> all;
    for (const Row& row : rows)
      all.push_back(row.response.name);
    return all;
  }();
  return names;
}

std::optional<std::size_t> find_response(std::span<const Response> responses, std::string_view name) {
  for (std::size_t i = 0; i < responses.size(); ++i) {
    if (responses[i].name == name)
      return i;
  }
  return std::nullopt;
}

std::vector<double> read_responses(std::span<const ForwardResult> results) {
  std::vector<double> values;
  for (const Row& row : rows)
    values.push_back(row.read(results));
  return values;
}

std::optional<std::string> find_unavailable_response(std::string_view name, const Gear& gear,
                                                     std::span<const Load> loads) {
  if (name == "transmission_error_arcsec") {
    for (const Load& load : loads) {
      if (load.phases > 1 && !load.torque_nm.empty())
        return std::nullopt;
    }
    return "needs a load case with torque_nm and phases above 1";
  }
  if (name == "disc_force_n" && gear.contact.fidelity == Fidelity::linear)
    return "is not known to contact.fidelity = \"linear\"; use \"unilateral\"";
  return std::nullopt;
}

} // namespace strainwave
