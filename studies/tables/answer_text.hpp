#pragma once
// How the answers of all kinds write numbers, for people and in result.json.

#include "strainwave/common/statistics/interval.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace strainwave {

/// Five digits; a dash for what is no number.
std::string number_in_words(double value);
/// "[lower, upper]"
std::string interval_in_words(const Interval& ci);
/// null for what is no number
nlohmann::ordered_json number_json(double value);
nlohmann::ordered_json interval_json(const Interval& interval);
/// {"value": …, "ci95": […]}
nlohmann::ordered_json estimate_json(const Estimate& estimate);

} // namespace strainwave
