#pragma once
// Where an output of a table is least and greatest.

#include "strainwave/studies/tables/row_study.hpp"

#include <string>
#include <vector>

namespace strainwave {

struct OutputRange {
  std::string output, unit;
  double least = 0.0, greatest = 0.0;
  std::uint64_t least_row = 0, greatest_row = 0;
};

/// Of every output that has a value, in the order of the columns.
std::vector<OutputRange> output_ranges(const SampledStudy& rows, const RowTable& table);

} // namespace strainwave
