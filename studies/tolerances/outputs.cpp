#include "strainwave/studies/tolerances/outputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace strainwave {

namespace {

enum Output : std::size_t {
  peak_force,
  force_ratio,
  engaged_count,
  lobe_share,
  rotation,
  torque,
  min_backlash,
  interference,
  loaded_gap,
  take_up,
  wind_up,
  secant,
  tangent
};

struct Row {
  Response response;
  bool largest; ///< is the largest the worst?
};

/// What an analysis calls so too, with its unit and sentence.
Response as_analysed(std::string_view name) {
  return gear_responses()[find_response(gear_responses(), name).value()];
}

const std::array<Row, sampled_output_count> rows{{
    {as_analysed("peak_force_n"), true},
    {as_analysed("force_ratio"), true},
    {{"engaged_count_all", "", "teeth of both lobes that carry load"}, false},
    {{"lobe_share", "", "share of the torque on the lobe that carries more"}, true},
    {as_analysed("rotation_rad"), true},
    {as_analysed("torque_nm"), false},
    {{"min_tooth_backlash_um", "µm", "least initial drive backlash of a tooth; negative: interference"},
     false},
    {{"tooth_interference_um", "µm",
      "overlap of the drive flanks of a tooth before any load; 0 where there is none"},
     true},
    {{"loaded_gap_um", "µm", "least gap of a tooth without load, under load"}, false},
    {as_analysed("take_up_rad"), true},
    {{"load_wind_up_rad", "rad", "rotation after the first contact under the load case"}, true},
    {{"load_secant_nm_per_rad", "N·m/rad", "torque of the load case over its wind-up"}, false},
    {as_analysed("tangent_stiffness_nm_per_rad"), false},
}};

} // namespace

std::span<const Response> sampled_responses() {
  static const auto responses = [] {
    std::vector<Response> all;
    for (const Row& row : rows)
      all.push_back(row.response);
    return all;
  }();
  return responses;
}

std::span<const std::string_view> sampled_response_names() {
  static const auto names = [] {
    std::vector<std::string_view> all;
    for (const Response& response : sampled_responses())
      all.push_back(response.name);
    return all;
  }();
  return names;
}

std::span<const StudyChecker::Counterpart> sampled_counterparts() {
  static const auto counterparts = [] {
    std::vector<StudyChecker::Counterpart> all;
    const auto add = [&](std::string_view name, std::string_view here) {
      all.push_back(
          {name, here, sampled_responses()[find_response(sampled_responses(), here).value()].sentence});
    };
    add("engaged_count", "engaged_count_all");
    add("min_backlash_um", "min_tooth_backlash_um");
    add("interference_um", "tooth_interference_um");
    add("wind_up_rad", "load_wind_up_rad");
    add("secant_nm_per_rad", "load_secant_nm_per_rad");
    return all;
  }();
  return counterparts;
}

SampledOutputs read_outputs(const SampledReading& reading) {
  const SampledState& state = reading.state;
  double peak = 0.0, sum = 0.0, first_lobe = 0.0, closest = std::numeric_limits<double>::infinity();
  double least = closest, touch = closest;
  int engaged = 0;
  for (std::size_t i = 0; i < state.force.size(); ++i) {
    const double force = state.force[i];
    least = std::min(least, reading.backlash_mm[i]);
    touch = std::min(touch, reading.backlash_mm[i] / reading.radius_mm[i]);
    if (force > 0.0) {
      peak = std::max(peak, force);
      sum += force;
      ++engaged;
      if (reading.phi_rad[i] <= 0.5 * std::numbers::pi + 1e-12)
        first_lobe += force * reading.radius_mm[i] * reading.cosine[i];
    } else {
      closest = std::min(closest, state.gap[i] / reading.cosine[i]);
    }
  }
  const double none = std::numeric_limits<double>::quiet_NaN();
  SampledOutputs out;
  out[peak_force] = peak;
  out[force_ratio] = engaged > 0 ? peak * engaged / sum : none;
  out[engaged_count] = engaged;
  const double share = state.torque > 0.0 ? first_lobe / state.torque : none;
  out[lobe_share] = std::max(share, 1.0 - share);
  out[rotation] = state.rotation;
  out[torque] = 1e-3 * state.torque;
  out[min_backlash] = 1e3 * least;
  out[interference] = std::max(0.0, -1e3 * least);
  out[loaded_gap] = 1e3 * closest;
  out[take_up] = std::max(0.0, touch);
  out[wind_up] = state.rotation - out[take_up];
  out[secant] = out[wind_up] > 0.0 ? out[torque] / out[wind_up] : none;
  out[tangent] = 1e-3 * state.stiffness;
  return out;
}

void worse_of(SampledOutputs& worst, const SampledOutputs& other) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    worst[k] = rows[k].largest ? std::max(worst[k], other[k]) : std::min(worst[k], other[k]);
}

} // namespace strainwave
