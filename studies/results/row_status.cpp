#include "strainwave/studies/results/row_status.hpp"

#include "strainwave/common/rows/row_model.hpp"

namespace strainwave {

std::string_view row_status_name(std::uint8_t status) {
  if (status < row_out_of_range)
    return status_name(static_cast<Status>(status));
  switch (status) {
  case row_out_of_range:
    return "out_of_range";
  case row_no_value:
    return "no_value";
  case row_not_finite:
    return "not_finite";
  case row_missing:
    return "missing";
  default:
    return "unknown";
  }
}

std::vector<std::string> row_status_names() {
  std::vector<std::string> names;
  for (std::uint8_t status = 0; status <= row_no_value; ++status)
    names.emplace_back(row_status_name(status));
  return names;
}

} // namespace strainwave
