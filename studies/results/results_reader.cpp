#include "strainwave/studies/results/results_reader.hpp"

#include "strainwave/common/rows/row_block.hpp"

#include <cerrno>
#include <cstring>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <system_error>

namespace strainwave {

namespace {

class Reader {
public:
  explicit Reader(const std::filesystem::path& path) : path_(path.string()) {
    if (!std::filesystem::exists(path))
      throw std::system_error(ENOENT, std::generic_category(), "cannot read " + path_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // errors are reported by exception, not printed
    file_ = demand(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  }
  ~Reader() { H5Fclose(file_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  StoredResults read() {
    StoredResults r;
    hsize_t shape[2] = {};
    demand(H5LTget_dataset_info(file_, "inputs", shape, nullptr, nullptr));
    r.rows = shape[0];
    r.inputs.resize(shape[0] * shape[1]);
    demand(H5LTget_dataset_info(file_, "outputs", shape, nullptr, nullptr));
    r.outputs.resize(shape[0] * shape[1]);
    r.status.resize(r.rows);
    if (!r.inputs.empty())
      demand(H5LTread_dataset_double(file_, "inputs", r.inputs.data()));
    if (!r.outputs.empty())
      demand(H5LTread_dataset_double(file_, "outputs", r.outputs.data()));
    if (r.rows > 0)
      demand(H5LTread_dataset(file_, "status", H5T_NATIVE_UINT8, r.status.data()));
    r.input_columns = columns("inputs");
    r.output_columns = columns("outputs");
    r.status_names = attribute("status", "names");
    read_messages(r);
    r.plan_hash = text_attribute("plan_hash");
    r.model_hash = text_attribute("model_hash");
    hsize_t none = 0;
    H5T_class_t kind{};
    std::size_t size = 0;
    demand(H5LTget_dataset_info(file_, "version", &none, &kind, &size));
    r.version.resize(size);
    demand(H5LTread_dataset_string(file_, "version", r.version.data()));
    r.version.resize(std::strlen(r.version.c_str()));
    return r;
  }

private:
  template <class T>
  T demand(T code) const {
    if (code < 0)
      throw std::system_error(EIO, std::generic_category(), path_ + " holds no results of a study");
    return code;
  }

  static std::vector<std::string> cut(const std::vector<char>& bytes, std::size_t width, std::size_t count) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < count; ++i)
      texts.emplace_back(bytes.data() + i * width, ::strnlen(bytes.data() + i * width, width));
    return texts;
  }

  std::vector<std::string> attribute(const char* set, const char* name) const {
    hsize_t count = 0;
    H5T_class_t kind{};
    std::size_t width = 0;
    demand(H5LTget_attribute_info(file_, set, name, &count, &kind, &width));
    if (count == 0)
      return {};
    std::vector<char> bytes(count * width + 1);
    const hid_t object = demand(H5Dopen2(file_, set, H5P_DEFAULT));
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    const herr_t code = H5Aread(attribute, type, bytes.data());
    H5Tclose(type);
    H5Aclose(attribute);
    H5Dclose(object);
    demand(code);
    return cut(bytes, width, count);
  }

  std::string text_attribute(const char* name) const {
    char bytes[64] = {};
    demand(H5LTget_attribute_string(file_, "/", name, bytes));
    return bytes;
  }

  std::vector<TableColumn> columns(const char* set) const {
    const auto names = attribute(set, "names"), units = attribute(set, "units");
    std::vector<TableColumn> all;
    for (std::size_t i = 0; i < names.size(); ++i)
      all.push_back({names[i], i < units.size() ? units[i] : ""});
    return all;
  }

  void read_messages(StoredResults& r) const {
    hsize_t count = 0;
    H5T_class_t kind{};
    std::size_t width = 0;
    demand(H5LTget_dataset_info(file_, "messages", &count, &kind, &width));
    if (count == 0)
      return;
    std::vector<char> bytes(count * width + 1);
    const hid_t set = demand(H5Dopen2(file_, "messages", H5P_DEFAULT));
    const hid_t type = H5Dget_type(set);
    const herr_t code = H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    H5Tclose(type);
    H5Dclose(set);
    demand(code);
    std::vector<unsigned long long> where(count);
    demand(H5LTread_dataset(file_, "messages_row", H5T_NATIVE_ULLONG, where.data()));
    const auto texts = cut(bytes, width, count);
    for (std::size_t i = 0; i < count; ++i)
      r.messages[where[i]] = texts[i];
  }

  std::string path_;
  hid_t file_ = -1;
};

} // namespace

std::string_view StoredResults::status_name(std::uint64_t row) const {
  const std::uint8_t s = status[row];
  if (s < status_names.size())
    return status_names[s];
  return s == row_missing ? "missing" : "not_finite";
}

StoredResults read_results_table(const std::filesystem::path& path) {
  return Reader(path).read();
}

} // namespace strainwave
