#include "strainwave/model/export/vtkhdf.hpp"

#include "strainwave/common/files/replaced_file.hpp"

#include <cassert>
#include <cerrno>

#include <hdf5.h>
#include <hdf5_hl.h>

namespace strainwave {

namespace {

/// Raised inside, turned into the sentence with the path outside.
struct Hdf5Refusal {};

template <class T>
T check(T code) {
  if (code < 0)
    throw Hdf5Refusal();
  return code;
}

/// An HDF5 identifier that closes itself.
class Handle {
public:
  Handle(hid_t identifier, herr_t (*closer)(hid_t)) : id(check(identifier)), close(closer) {}
  ~Handle() { close(id); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id; } // NOLINT: implicit on purpose

private:
  hid_t id;
  herr_t (*close)(hid_t);
};

void put(hid_t group, const char* name, hid_t in_file, hid_t in_memory, const void* values,
         std::vector<hsize_t> shape) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const Handle set(H5Dcreate2(group, name, in_file, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  check(H5Dwrite(set, in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
}

void put(hid_t group, const char* name, const std::vector<std::int64_t>& values) {
  put(group, name, H5T_STD_I64LE, H5T_NATIVE_INT64, values.data(), {values.size()});
}

/// The reader compares Type with a fixed-length ASCII string.
void put_header(hid_t group) {
  const long long version[2] = {1, 0};
  check(H5LTset_attribute_long_long(group, ".", "Version", version, 2));
  const std::string type = "UnstructuredGrid";
  const Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(text, type.size()));
  check(H5Tset_strpad(text, H5T_STR_NULLPAD));
  check(H5Tset_cset(text, H5T_CSET_ASCII));
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(group, "Type", text, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(attribute, text, type.data()));
}

void put_arrays(hid_t parent, const char* name, const std::vector<GridArray>& arrays) {
  const Handle group(H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  for (const GridArray& array : arrays) {
    const auto components = static_cast<hsize_t>(array.components);
    const auto shape = [&](std::size_t size) {
      return components == 1 ? std::vector<hsize_t>{size}
                             : std::vector<hsize_t>{size / components, components};
    };
    if (const auto* real = std::get_if<std::vector<double>>(&array.values))
      put(group, array.name.c_str(), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, real->data(), shape(real->size()));
    else if (const auto* whole = std::get_if<std::vector<std::int32_t>>(&array.values))
      put(group, array.name.c_str(), H5T_STD_I32LE, H5T_NATIVE_INT32, whole->data(), shape(whole->size()));
    check(H5LTset_attribute_string(group, array.name.c_str(), "units", array.unit.c_str()));
  }
}

void put_grid(hid_t file, const UnstructuredGrid& grid, const std::string& config) {
  const Handle group(H5Gcreate2(file, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  put_header(group);
  put(group, "NumberOfPoints", {static_cast<std::int64_t>(grid.points.size() / 3)});
  put(group, "NumberOfCells", {static_cast<std::int64_t>(grid.types.size())});
  put(group, "NumberOfConnectivityIds", {static_cast<std::int64_t>(grid.connectivity.size())});
  put(group, "Points", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, grid.points.data(), {grid.points.size() / 3, 3});
  put(group, "Connectivity", grid.connectivity);
  put(group, "Offsets", grid.offsets);
  put(group, "Types", H5T_STD_U8LE, H5T_NATIVE_UINT8, grid.types.data(), {grid.types.size()});
  put_arrays(group, "PointData", grid.point_data);
  put_arrays(group, "CellData", grid.cell_data);
  check(H5LTmake_dataset_string(file, "config", config.c_str()));
}

} // namespace

void write_vtkhdf(const UnstructuredGrid& grid, const std::string& config,
                  const std::filesystem::path& path) {
  assert(grid.offsets.size() == grid.types.size() + 1);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // errors are reported by exception, not printed
  if (std::filesystem::is_directory(path))
    cannot_write(path, EISDIR);
  const std::filesystem::path beside = path.string() + ".part";
  errno = 0;
  const hid_t file = H5Fcreate(beside.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (file < 0)
    cannot_write(path, errno);
  try {
    put_grid(file, grid, config);
    check(H5Fflush(file, H5F_SCOPE_GLOBAL));
  } catch (const Hdf5Refusal&) {
    const int error = errno;
    H5Fclose(file);
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    cannot_write(path, error);
  }
  std::error_code error;
  if (H5Fclose(file) < 0)
    cannot_write(path, errno);
  std::filesystem::rename(beside, path, error);
  if (error)
    cannot_write(path, error.value());
}

} // namespace strainwave
