#pragma once
// results.h5 of a study whose rows are known: derived from the journal, written beside and renamed, never
// opened for update.
//
//     /inputs      rows × inputs     attributes names, units
//     /outputs     rows × outputs    attributes names, units; NaN in rows without a result
//     /status      rows              0 ok, 255 missing, else an index into the attribute names
//     /messages    text of failed rows, /messages_row their rows
//     /timing      seconds of each block of rows (attribute block_rows); all that differs between runs
//     /config, /version
//     attributes format, format_version, plan_hash, model_hash, missing_rows at the root

#include "strainwave/common/rows/row_table.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>

namespace strainwave {

/// The format_version that this program writes, and the newest that it reads.
inline constexpr std::int32_t results_format = 1;

struct TableColumn {
  std::string name;
  std::string unit;
};

struct ResultsTable {
  std::vector<TableColumn> inputs; ///< named scalars; may be empty
  std::vector<TableColumn> outputs;
  /// Inputs of rows first … first + count − 1, row by row. Rows are drawn again from the plan, so a study of
  /// any size needs no memory for them. Not called without inputs.
  std::function<void(std::uint64_t first, std::size_t count, std::span<double>)> input_rows;
  std::vector<std::string> status_names; ///< sentence of status 0, 1, 2 …
  std::string config;                    ///< the resolved study file
  std::string version;
  std::uint64_t plan_hash = 0;
  std::uint64_t model_hash = 0;
};

/// Throws std::system_error: disk full, no permission. A results.h5 that was there then stays.
void write_results_table(const ResultsTable&, const RowTable&, const std::filesystem::path&);

} // namespace strainwave
