#pragma once
// The outputs of one sample and how the worst of several positions and loads is taken.

#include "strainwave/model/lcp/sampled_contact.hpp"
#include "strainwave/model/results/response.hpp"
#include "strainwave/studies/file/checker.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace strainwave {

/// The outputs that a row of monte_carlo or sensitivity can have; study files are checked against their
/// names. A name that an analysis has too (response.hpp) means the same. Response::unit is for people ("µm").
std::span<const Response> sampled_responses();
/// Their names alone, in the same order.
std::span<const std::string_view> sampled_response_names();
/// Responses of an analysis that samples do not have, and what they have instead.
std::span<const StudyChecker::Counterpart> sampled_counterparts();

inline constexpr std::size_t sampled_output_count = 13;
using SampledOutputs = std::array<double, sampled_output_count>; ///< in the order of sampled_responses()

/// What an output is read from.
struct SampledReading {
  const SampledState& state;
  std::span<const double> backlash_mm; ///< c of the sample
  std::span<const double> radius_mm;   ///< R
  std::span<const double> cosine;      ///< of the teeth's pressure angles
  std::span<const double> phi_rad;     ///< material angles; the second lobe lies above π/2
};

SampledOutputs read_outputs(const SampledReading& reading);

/// Keeps of each output the worse one.
void worse_of(SampledOutputs& worst, const SampledOutputs& other);

} // namespace strainwave
