#pragma once
// Derivatives of the responses of response.hpp from those of the forward results: of the load, phase and
// tooth that are the worst of all. Where two are equally bad the response has a kink and this is one side of
// it.

#include "strainwave/model/results/forward_gradient.hpp"
#include "strainwave/model/results/response.hpp"

namespace strainwave {

/// By response (order of gear_responses()) and parameter: [r · parameters + j]. NaN where no derivative is
/// known. `results` and `gradients` belong to each other, one by one.
std::vector<double> read_response_gradient(std::span<const ForwardResult> results,
                                           std::span<const ForwardGradient> gradients);

} // namespace strainwave
