#pragma once
// Status of the rows of gear studies: 0 ok, then the model's own reasons in the order of Status, then two
// that only a study has. results.h5 carries the names.

#include "strainwave/common/core/outcome.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

inline constexpr std::uint8_t row_status_of(Status status) {
  return static_cast<std::uint8_t>(status);
}
/// A number left the range of its key (a linked number, a drawn one).
inline constexpr std::uint8_t row_out_of_range = row_status_of(Status::certificate_failed) + 1;
/// The gear has a result, but an output that is asked for has no value (a force ratio without any force).
inline constexpr std::uint8_t row_no_value = row_out_of_range + 1;

std::string_view row_status_name(std::uint8_t status);
/// By status, from 0.
std::vector<std::string> row_status_names();

} // namespace strainwave
