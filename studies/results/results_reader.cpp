#include "strainwave/studies/results/results_reader.hpp"

#include "strainwave/common/files/hdf5.hpp"
#include "strainwave/common/rows/row_block.hpp"

#include <cerrno>
#include <fmt/format.h>
#include <system_error>

namespace strainwave {

namespace {

std::vector<TableColumn> columns_of(const hdf5::Dataset& set) {
  const auto names = set.texts("names"), units = set.texts("units");
  std::vector<TableColumn> all;
  for (std::size_t i = 0; i < names.size(); ++i)
    all.push_back({names[i], i < units.size() ? units[i] : ""});
  return all;
}

StoredResults read(const hdf5::File& file) {
  StoredResults r;
  const hdf5::Dataset inputs = file.dataset("inputs"), outputs = file.dataset("outputs");
  r.inputs = inputs.read<double>();
  r.outputs = outputs.read<double>();
  r.input_columns = columns_of(inputs);
  r.output_columns = columns_of(outputs);
  const hdf5::Dataset status = file.dataset("status");
  r.status = status.read<std::uint8_t>();
  r.status_names = status.texts("names");
  r.rows = r.status.size();
  const auto texts = file.dataset("messages").read_texts();
  const auto where = file.dataset("messages_row").read<std::uint64_t>();
  if (inputs.shape() != hdf5::Shape{r.rows, r.input_columns.size()} ||
      outputs.shape() != hdf5::Shape{r.rows, r.output_columns.size()} || texts.size() != where.size())
    throw std::system_error(EIO, std::generic_category());
  for (std::size_t i = 0; i < texts.size(); ++i)
    r.messages[where[i]] = texts[i];
  r.plan_hash = file.text("plan_hash");
  r.model_hash = file.text("model_hash");
  r.version = file.dataset("version").read_text();
  return r;
}

} // namespace

std::string_view StoredResults::status_name(std::uint64_t row) const {
  const std::uint8_t s = status[row];
  if (s < status_names.size())
    return status_names[s];
  return s == row_missing ? "missing" : "not_finite";
}

StoredResults read_results_table(const std::filesystem::path& path) {
  try {
    const hdf5::File file(path);
    if (const std::int32_t version = file.format().version; version > results_format)
      throw std::system_error(
          ENOTSUP, std::generic_category(),
          fmt::format("{} is of format {}, which a newer strainwave wrote; this one reads up to {}",
                      path.string(), version, results_format));
    return read(file);
  } catch (const std::system_error& error) {
    if (error.code().value() == ENOENT || error.code().value() == ENOTSUP)
      throw;
    throw std::system_error(EIO, std::generic_category(), path.string() + " holds no results of a study");
  }
}

} // namespace strainwave
