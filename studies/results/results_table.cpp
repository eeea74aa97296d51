#include "strainwave/studies/results/results_table.hpp"

#include "strainwave/common/files/content_hash.hpp"
#include "strainwave/common/files/hdf5.hpp"

#include <algorithm>
#include <limits>

namespace strainwave {

namespace {

/// Rows written at once.
constexpr std::size_t rows_at_once = 16384;

hdf5::Dataset put_columns(const hdf5::Group& file, const char* name, const std::vector<TableColumn>& columns,
                          std::size_t rows) {
  std::vector<std::string> names, units;
  for (const TableColumn& column : columns) {
    names.push_back(column.name);
    units.push_back(column.unit);
  }
  hdf5::Dataset set = file.make_dataset<double>(name, {rows, columns.size()});
  set.set_texts("names", names);
  set.set_texts("units", units);
  return set;
}

/// Rows without a result hold NaN here, so that nobody takes their zeros for numbers.
void put_outputs(const hdf5::Group& file, const ResultsTable& results, const RowTable& table) {
  const std::size_t columns = table.outputs();
  const hdf5::Dataset set = put_columns(file, "outputs", results.outputs, table.rows());
  std::vector<double> rows;
  for (std::size_t first = 0; columns > 0 && first < table.rows(); first += rows_at_once) {
    const std::size_t count = std::min<std::size_t>(rows_at_once, table.rows() - first);
    const auto values = table.values().subspan(first * columns, count * columns);
    rows.assign(values.begin(), values.end());
    for (std::size_t k = 0; k < count; ++k)
      if (table.status()[first + k] != row_ok)
        std::fill_n(rows.begin() + static_cast<std::ptrdiff_t>(k * columns), columns,
                    std::numeric_limits<double>::quiet_NaN());
    set.write_rows(first, rows);
  }
}

void put_inputs(const hdf5::Group& file, const ResultsTable& results, const RowTable& table) {
  const std::size_t columns = results.inputs.size();
  const hdf5::Dataset set = put_columns(file, "inputs", results.inputs, table.rows());
  std::vector<double> rows;
  for (std::size_t first = 0; columns > 0 && first < table.rows(); first += rows_at_once) {
    const std::size_t count = std::min<std::size_t>(rows_at_once, table.rows() - first);
    rows.resize(count * columns);
    results.input_rows(first, count, rows);
    set.write_rows(first, rows);
  }
}

void put_status(const hdf5::Group& file, const ResultsTable& results, const RowTable& table) {
  file.put("status", table.status()).set_texts("names", results.status_names);
  std::vector<std::string> texts;
  std::vector<std::uint64_t> where;
  for (const auto& [row, text] : table.messages()) {
    where.push_back(row);
    texts.push_back(text);
  }
  file.put_texts("messages", texts);
  file.put("messages_row", where);
}

} // namespace

void write_results_table(const ResultsTable& results, const RowTable& table,
                         const std::filesystem::path& path) {
  hdf5::write_file(path, {"strainwave results", results_format}, [&](const hdf5::Group& file) {
    put_inputs(file, results, table);
    put_outputs(file, results, table);
    put_status(file, results, table);
    const hdf5::Dataset timing = file.put("timing", table.block_seconds());
    timing.set_number("block_rows", static_cast<std::uint64_t>(table.block_rows()));
    timing.set_text("units", "s");
    file.put_text("config", results.config);
    file.put_text("version", results.version);
    file.set_text("plan_hash", hash_text(results.plan_hash));
    file.set_text("model_hash", hash_text(results.model_hash));
    file.set_number("missing_rows", static_cast<std::uint64_t>(table.rows() - table.done()));
  });
}

} // namespace strainwave
