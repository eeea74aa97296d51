#pragma once
// results.h5 read back: what compare, report and eval look at.

#include "strainwave/studies/results/results_table.hpp"

#include <filesystem>
#include <map>
#include <vector>

namespace strainwave {

struct StoredResults {
  std::vector<TableColumn> input_columns, output_columns;
  std::uint64_t rows = 0;
  std::vector<double> inputs, outputs; ///< rows × columns; outputs are NaN in rows without a result
  std::vector<std::uint8_t> status;
  std::vector<std::string> status_names;
  std::map<std::uint64_t, std::string> messages;
  std::string plan_hash, model_hash, version;

  std::string_view status_name(std::uint64_t row) const;
};

/// Throws std::system_error for a file that is not there or is none of ours.
StoredResults read_results_table(const std::filesystem::path& path);

} // namespace strainwave
