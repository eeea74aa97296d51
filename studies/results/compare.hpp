#pragma once
// The difference of two results: row by row where they have the same inputs.

#include "strainwave/studies/results/results_reader.hpp"

#include <optional>

namespace strainwave {

struct OutputDifference {
  std::string output, unit;
  std::uint64_t rows = 0;      ///< with a result on both sides
  std::uint64_t different = 0; ///< whose bits differ
  double largest = 0.0;        ///< magnitude of the difference
  double relative = 0.0;       ///< largest of |difference| over the larger magnitude
  std::uint64_t row = 0;       ///< of `largest`, in the first result
};

struct ResultsDifference {
  std::uint64_t first_rows = 0, second_rows = 0;
  std::uint64_t matched = 0; ///< rows with the same bits of all inputs
  std::uint64_t status_different = 0;
  std::optional<std::uint64_t> status_row; ///< the first of them
  std::vector<OutputDifference> outputs;   ///< those that both have
  std::vector<std::string> only_first, only_second;
  bool identical = false; ///< same rows, columns, inputs, status and bits of outputs
};

/// Rows are matched by their inputs, in any order. Throws std::invalid_argument where the inputs are other
/// numbers.
ResultsDifference compare_results(const StoredResults& first, const StoredResults& second);

} // namespace strainwave
