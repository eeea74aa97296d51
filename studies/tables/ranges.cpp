#include "strainwave/studies/tables/ranges.hpp"

namespace strainwave {

std::vector<OutputRange> output_ranges(const SampledStudy& rows, const RowTable& table) {
  std::vector<OutputRange> ranges;
  for (std::uint32_t output = 0; output < table.outputs(); ++output) {
    std::optional<OutputRange> range;
    for (std::uint64_t row = 0; row < table.rows(); ++row) {
      if (table.status()[row] != row_ok)
        continue;
      const double value = table.value(row, output);
      if (!range)
        range = OutputRange{
            rows.output_columns[output].name, rows.output_columns[output].unit, value, value, row, row};
      if (value < range->least)
        range->least = value, range->least_row = row;
      if (value > range->greatest)
        range->greatest = value, range->greatest_row = row;
    }
    if (range)
      ranges.push_back(std::move(*range));
  }
  return ranges;
}

} // namespace strainwave
