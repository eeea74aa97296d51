#pragma once
// The named numbers that a study may minimise, limit or record, with their units. One table for all: the
// reader of study files checks names against it, the evaluator fills it, results and reports take their units
// from it.
//
// With several load cases a response is the worst of them: the largest force, the least stiffness.

#include "strainwave/model/results/result.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

struct Response {
  std::string_view name;
  std::string_view unit; ///< empty: a plain number
  std::string_view sentence;
};

std::span<const Response> gear_responses();
/// Their names alone, in the same order.
std::span<const std::string_view> gear_response_names();
std::optional<std::size_t> find_response(std::span<const Response> responses, std::string_view name);

/// Values in the order of gear_responses(), worst over the load cases of all `results` (analyses of one gear
/// that differ in their loads only). NaN for what these loads do not give: no transmission error with one
/// phase.
std::vector<double> read_responses(std::span<const ForwardResult> results);

/// Why a response is not to be had from a gear with these loads, and the remedy. Nothing if it is.
std::optional<std::string> find_unavailable_response(std::string_view name, const Gear& gear,
                                                     std::span<const Load> loads);

} // namespace strainwave
