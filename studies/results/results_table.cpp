#include "strainwave/studies/results/results_table.hpp"

#include "strainwave/common/files/content_hash.hpp"
#include "strainwave/common/files/whole_file.hpp"

#include <algorithm>
#include <cerrno>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <limits>
#include <system_error>
#include <utility>

namespace strainwave {

namespace {

template <class T>
T demand(T code) {
  if (code < 0)
    throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(),
                            "HDF5 could not write the results");
  return code;
}

/// An HDF5 identifier that closes itself.
class Handle {
public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(demand(id)), close_(close) {}
  ~Handle() {
    if (id_ >= 0)
      close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t id() const { return id_; }
  void close_now() { demand(close_(std::exchange(id_, -1))); } ///< a full disk may show only here

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// A list of texts of equal room, as a dataset (parent, name) or as an attribute of `object`.
struct TextList {
  std::vector<char> bytes;
  Handle type{H5Tcopy(H5T_C_S1), H5Tclose};
  hsize_t count;
  explicit TextList(const std::vector<std::string>& texts) : count(texts.size()) {
    std::size_t width = 1;
    for (const auto& text : texts)
      width = std::max(width, text.size() + 1);
    demand(H5Tset_size(type.id(), width));
    demand(H5Tset_cset(type.id(), H5T_CSET_UTF8));
    bytes.assign(std::max<std::size_t>(width * texts.size(), 1), '\0');
    for (std::size_t i = 0; i < texts.size(); ++i)
      std::ranges::copy(texts[i], bytes.begin() + static_cast<std::ptrdiff_t>(i * width));
  }
};

void put_texts(hid_t file, const char* name, const std::vector<std::string>& texts) {
  const TextList list(texts);
  Handle space(H5Screate_simple(1, &list.count, nullptr), H5Sclose);
  Handle set(H5Dcreate2(file, name, list.type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             H5Dclose);
  if (list.count > 0)
    demand(H5Dwrite(set.id(), list.type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, list.bytes.data()));
}

void put_attribute(hid_t object, const char* name, const std::vector<std::string>& texts) {
  const TextList list(texts);
  Handle space(H5Screate_simple(1, &list.count, nullptr), H5Sclose);
  Handle set(H5Acreate2(object, name, list.type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (list.count > 0)
    demand(H5Awrite(set.id(), list.type.id(), list.bytes.data()));
}

void put_columns(hid_t set, const std::vector<TableColumn>& columns) {
  std::vector<std::string> names, units;
  for (const TableColumn& column : columns) {
    names.push_back(column.name);
    units.push_back(column.unit);
  }
  put_attribute(set, "names", names);
  put_attribute(set, "units", units);
}

void put_rows(hid_t set, hid_t space, hsize_t first, hsize_t count, hsize_t columns,
              const std::vector<double>& rows) {
  const hsize_t start[2] = {first, 0}, size[2] = {count, columns};
  Handle memory(H5Screate_simple(2, size, nullptr), H5Sclose);
  demand(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr));
  demand(H5Dwrite(set, H5T_NATIVE_DOUBLE, memory.id(), space, H5P_DEFAULT, rows.data()));
}

/// Rows without a result hold NaN here, so that nobody takes their zeros for numbers.
void put_outputs(hid_t file, const ResultsTable& results, const RowTable& table) {
  const hsize_t columns = table.outputs();
  const hsize_t shape[2] = {table.rows(), columns};
  Handle space(H5Screate_simple(2, shape, nullptr), H5Sclose);
  Handle set(H5Dcreate2(file, "outputs", H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             H5Dclose);
  put_columns(set.id(), results.outputs);
  std::vector<double> rows;
  for (hsize_t first = 0; columns > 0 && first < table.rows();) {
    const hsize_t count = std::min<hsize_t>(16384, table.rows() - first);
    const auto values = table.values().subspan(first * columns, count * columns);
    rows.assign(values.begin(), values.end());
    for (hsize_t k = 0; k < count; ++k)
      if (table.status()[first + k] != row_ok)
        std::fill_n(rows.begin() + static_cast<std::ptrdiff_t>(k * columns), columns,
                    std::numeric_limits<double>::quiet_NaN());
    put_rows(set.id(), space.id(), first, count, columns, rows);
    first += count;
  }
}

void put_inputs(hid_t file, const ResultsTable& results, const RowTable& table) {
  const hsize_t columns = results.inputs.size();
  const hsize_t shape[2] = {table.rows(), columns};
  Handle space(H5Screate_simple(2, shape, nullptr), H5Sclose);
  Handle set(H5Dcreate2(file, "inputs", H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             H5Dclose);
  put_columns(set.id(), results.inputs);
  std::vector<double> rows;
  for (hsize_t first = 0; columns > 0 && first < table.rows();) {
    const hsize_t count = std::min<hsize_t>(16384, table.rows() - first);
    rows.resize(count * columns);
    results.input_rows(first, count, rows);
    put_rows(set.id(), space.id(), first, count, columns, rows);
    first += count;
  }
}

void put_status(hid_t file, const ResultsTable& results, const RowTable& table) {
  const hsize_t rows = table.rows();
  Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose);
  Handle set(H5Dcreate2(file, "status", H5T_STD_U8LE, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             H5Dclose);
  demand(H5Dwrite(set.id(), H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, table.status().data()));
  put_attribute(set.id(), "names", results.status_names);

  std::vector<std::string> texts;
  std::vector<unsigned long long> where;
  for (const auto& [row, text] : table.messages()) {
    where.push_back(row);
    texts.push_back(text);
  }
  put_texts(file, "messages", texts);
  const hsize_t count = where.size();
  Handle list(H5Screate_simple(1, &count, nullptr), H5Sclose);
  Handle numbers(
      H5Dcreate2(file, "messages_row", H5T_STD_U64LE, list.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
  if (count > 0)
    demand(H5Dwrite(numbers.id(), H5T_NATIVE_ULLONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, where.data()));
}

void put_all(hid_t file, const ResultsTable& results, const RowTable& table) {
  put_inputs(file, results, table);
  put_outputs(file, results, table);
  put_status(file, results, table);
  const hsize_t blocks = table.blocks();
  demand(H5LTmake_dataset_double(file, "timing", 1, &blocks, table.block_seconds().data()));
  const unsigned block_rows = table.block_rows();
  demand(H5LTset_attribute_uint(file, "timing", "block_rows", &block_rows, 1));
  demand(H5LTset_attribute_string(file, "timing", "units", "s"));
  demand(H5LTmake_dataset_string(file, "config", results.config.c_str()));
  demand(H5LTmake_dataset_string(file, "version", results.version.c_str()));
  demand(H5LTset_attribute_string(file, "/", "plan_hash", hash_text(results.plan_hash).c_str()));
  demand(H5LTset_attribute_string(file, "/", "model_hash", hash_text(results.model_hash).c_str()));
  const unsigned long missing = table.rows() - table.done();
  demand(H5LTset_attribute_ulong(file, "/", "missing_rows", &missing, 1));
}

} // namespace

void write_results_table(const ResultsTable& results, const RowTable& table,
                         const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // errors are reported by exception, not printed
  write_whole_file(path, [&](const std::filesystem::path& beside) {
    errno = 0;
    const hid_t id = H5Fcreate(beside.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (id < 0)
      throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(),
                              "cannot write " + path.string());
    Handle file(id, H5Fclose);
    put_all(file.id(), results, table);
    demand(H5Fflush(file.id(), H5F_SCOPE_GLOBAL));
    file.close_now();
  });
}

} // namespace strainwave
