#include "strainwave/common/files/hdf5.hpp"

#include "strainwave/common/files/whole_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <mutex>
#include <system_error>
#include <type_traits>

namespace strainwave::hdf5 {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>, "the header says so");

namespace {

/// Recursive: a thread may compare two files.
std::recursive_mutex in_use;

hid_t memory_type(NumberType type) {
  switch (type) {
  case NumberType::float64:
    return H5T_NATIVE_DOUBLE;
  case NumberType::int32:
    return H5T_NATIVE_INT32;
  case NumberType::int64:
    return H5T_NATIVE_INT64;
  case NumberType::uint8:
    return H5T_NATIVE_UINT8;
  default:
    return H5T_NATIVE_UINT64;
  }
}

hid_t file_type(NumberType type) {
  switch (type) {
  case NumberType::float64:
    return H5T_IEEE_F64LE;
  case NumberType::int32:
    return H5T_STD_I32LE;
  case NumberType::int64:
    return H5T_STD_I64LE;
  case NumberType::uint8:
    return H5T_STD_U8LE;
  default:
    return H5T_STD_U64LE;
  }
}

Handle space_of(const Shape& shape) {
  const std::vector<hsize_t> size(shape.begin(), shape.end());
  return {shape.empty() ? H5Screate(H5S_SCALAR)
                        : H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
          H5Sclose};
}

/// UTF-8 of any length.
Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

std::vector<const char*> pointers(std::span<const std::string> texts) {
  std::vector<const char*> all;
  for (const std::string& text : texts)
    all.push_back(text.c_str());
  return all;
}

/// Without times, so that the same content is the same bytes.
Handle timeless(hid_t kind) {
  Handle list(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(list.id(), false);
  return list;
}

std::vector<std::size_t> extent(hid_t space) {
  std::vector<hsize_t> size(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 0)));
  if (!size.empty())
    H5Sget_simple_extent_dims(space, size.data(), nullptr);
  return {size.begin(), size.end()};
}

/// Texts of any or of fixed length; `read(type, bytes)` is H5Dread or H5Aread. False: it failed.
template <class Read>
bool take_texts(hid_t type, hid_t space, std::vector<std::string>& texts, const Read& read) {
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (H5Tget_class(type) != H5T_STRING || count < 0)
    return false;
  texts.resize(static_cast<std::size_t>(count));
  if (texts.empty())
    return true;
  if (H5Tis_variable_str(type) > 0) {
    std::vector<char*> all(texts.size(), nullptr);
    const bool done = read(type, all.data()) >= 0;
    for (std::size_t i = 0; done && i < all.size(); ++i)
      texts[i] = all[i] != nullptr ? all[i] : "";
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, all.data());
    return done;
  }
  const std::size_t width = H5Tget_size(type);
  std::vector<char> bytes(width * texts.size());
  if (read(type, bytes.data()) < 0)
    return false;
  for (std::size_t i = 0; i < texts.size(); ++i)
    texts[i].assign(bytes.data() + i * width, ::strnlen(bytes.data() + i * width, width));
  return true;
}

} // namespace

Object::Object(Handle handle, std::string name, std::shared_ptr<const Place> place)
    : handle_(std::move(handle)), name_(std::move(name)), place_(std::move(place)) {
  if (handle_.id() < 0)
    refuse("");
}

/// `name` is a dataset, group or attribute of this object; "" this object itself.
void Object::refuse(const std::string& name) const {
  std::error_code unknown;
  int cause = place_->written && errno != 0 ? errno : EIO;
  if (!place_->written && !std::filesystem::exists(place_->file, unknown))
    cause = ENOENT;
  std::string object = name_;
  if (!name.empty())
    object += "/" + name;
  throw std::system_error(cause, std::generic_category(),
                          fmt::format("cannot {} {}{}", place_->written ? "write" : "read",
                                      place_->file.string(),
                                      object.empty() ? "" : fmt::format(" ({})", object)));
}

void Object::set_text(const std::string& attribute, std::string_view text) const {
  const Handle type = text_type(), space = space_of({});
  const Handle set(H5Acreate2(id(), attribute.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
  const std::string copy(text);
  const char* start = copy.c_str();
  demand(H5Awrite(demand(set.id(), attribute), type.id(), &start), attribute);
}

void Object::set_ascii(const std::string& attribute, const std::string& text) const {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space = space_of({});
  H5Tset_size(type.id(), text.size());
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  const Handle set(H5Acreate2(id(), attribute.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
  demand(H5Awrite(demand(set.id(), attribute), type.id(), text.data()), attribute);
}

void Object::set_texts(const std::string& attribute, std::span<const std::string> texts) const {
  const Handle type = text_type(), space = space_of({texts.size()});
  const Handle set(H5Acreate2(id(), attribute.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
  demand(set.id(), attribute);
  if (!texts.empty())
    demand(H5Awrite(set.id(), type.id(), pointers(texts).data()), attribute);
}

void Object::set_numbers(const std::string& attribute, NumberType type, const void* numbers,
                         const std::size_t* count) const {
  const Handle space = space_of(count != nullptr ? Shape{*count} : Shape{});
  const Handle set(H5Acreate2(id(), attribute.c_str(), file_type(type), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
  demand(H5Awrite(demand(set.id(), attribute), memory_type(type), numbers), attribute);
}

bool Object::has_attribute(const std::string& attribute) const {
  return H5Aexists(id(), attribute.c_str()) > 0;
}

std::string Object::text(const std::string& attribute) const {
  const auto all = texts(attribute);
  if (all.size() != 1)
    refuse(attribute);
  return all.front();
}

std::vector<std::string> Object::texts(const std::string& attribute) const {
  const Handle set(H5Aopen(id(), attribute.c_str(), H5P_DEFAULT), H5Aclose);
  demand(set.id(), attribute);
  const Handle type(H5Aget_type(set.id()), H5Tclose), space(H5Aget_space(set.id()), H5Sclose);
  std::vector<std::string> texts;
  if (!take_texts(type.id(), space.id(), texts,
                  [&](hid_t memory, void* bytes) { return H5Aread(set.id(), memory, bytes); }))
    refuse(attribute);
  return texts;
}

void Object::read_number(const std::string& attribute, NumberType type, void* number) const {
  const Handle set(H5Aopen(id(), attribute.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(demand(set.id(), attribute)), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.id()) != 1)
    refuse(attribute);
  demand(H5Aread(set.id(), memory_type(type), number), attribute);
}

Shape Dataset::shape() const {
  const Handle space(H5Dget_space(id()), H5Sclose);
  return extent(space.id());
}

std::size_t Dataset::size() const {
  std::size_t product = 1;
  for (const std::size_t length : shape())
    product *= length;
  return product;
}

/// How many numbers, where they are there and fit into `wanted`.
std::size_t Dataset::demand_stored(NumberType wanted) const {
  const Handle type(H5Dget_type(id()), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.id());
  const std::size_t bytes = H5Tget_size(type.id()), count = size();
  const bool fits = kind == H5T_INTEGER || (kind == H5T_FLOAT && wanted == NumberType::float64);
  if (!fits || bytes > H5Tget_size(memory_type(wanted)) || count > H5Dget_storage_size(id()) / bytes)
    refuse("");
  return count;
}

void Dataset::read_all(NumberType type, void* numbers) const {
  if (size() > 0)
    demand(H5Dread(id(), memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers), "");
}

std::vector<std::string> Dataset::read_texts() const {
  const Handle type(H5Dget_type(id()), H5Tclose), space(H5Dget_space(id()), H5Sclose);
  std::vector<std::string> texts;
  if (size() > H5Dget_storage_size(id()) ||
      !take_texts(type.id(), space.id(), texts, [&](hid_t memory, void* bytes) {
        return H5Dread(id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes);
      }))
    refuse("");
  return texts;
}

std::string Dataset::read_text() const {
  const auto all = read_texts();
  if (all.size() != 1)
    refuse("");
  return all.front();
}

void Dataset::write_all(NumberType type, const void* numbers) const {
  demand(H5Dwrite(id(), memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers), "");
}

void Dataset::write_rows(std::size_t first, std::span<const double> rows) const {
  const Shape whole = shape();
  if (whole.size() != 2 || whole[1] == 0 || rows.size() % whole[1] != 0)
    throw std::invalid_argument("rows do not fit the matrix " + name_);
  const hsize_t start[2] = {first, 0}, part[2] = {rows.size() / whole[1], whole[1]};
  const Handle memory(H5Screate_simple(2, part, nullptr), H5Sclose), space(H5Dget_space(id()), H5Sclose);
  demand(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start, nullptr, part, nullptr), "");
  demand(H5Dwrite(id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT, rows.data()), "");
}

void Dataset::make_scale(const std::string& name) const {
  demand(H5DSset_scale(id(), name.c_str()), "");
}

void Dataset::attach_scale(unsigned axis, const Dataset& scale) const {
  demand(H5DSattach_scale(id(), scale.id(), axis), "");
}

Group Group::make_group(const std::string& name) const {
  const Handle list = timeless(H5P_GROUP_CREATE);
  return {Handle(H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, list.id(), H5P_DEFAULT), H5Gclose),
          name_ + "/" + name, place_};
}

Dataset Group::make_dataset(const std::string& name, NumberType type, const Shape& shape) const {
  const Handle space = space_of(shape), list = timeless(H5P_DATASET_CREATE);
  return {
      Handle(H5Dcreate2(id(), name.c_str(), file_type(type), space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
             H5Dclose),
      name_ + "/" + name, place_};
}

Dataset Group::put(const std::string& name, NumberType type, const void* numbers, std::size_t count,
                   const Shape& shape) const {
  Dataset set = make_dataset(name, type, shape);
  if (set.size() != count)
    throw std::invalid_argument("numbers do not fit the shape of " + name_ + "/" + name);
  if (count > 0)
    set.write_all(type, numbers);
  return set;
}

Dataset Group::put_text(const std::string& name, std::string_view text) const {
  const Handle type = text_type(), space = space_of({}), list = timeless(H5P_DATASET_CREATE);
  Dataset set(
      Handle(H5Dcreate2(id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
             H5Dclose),
      name_ + "/" + name, place_);
  const std::string copy(text);
  const char* start = copy.c_str();
  demand(H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &start), name);
  return set;
}

Dataset Group::put_texts(const std::string& name, std::span<const std::string> texts) const {
  const Handle type = text_type(), space = space_of({texts.size()}), list = timeless(H5P_DATASET_CREATE);
  Dataset set(
      Handle(H5Dcreate2(id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
             H5Dclose),
      name_ + "/" + name, place_);
  if (!texts.empty())
    demand(H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers(texts).data()), name);
  return set;
}

bool Group::has(const std::string& name) const {
  for (std::size_t end = name.find('/');; end = name.find('/', end + 1)) { // each part, or HDF5 complains
    if (H5Lexists(id(), name.substr(0, end).c_str(), H5P_DEFAULT) <= 0)
      return false;
    if (end == std::string::npos)
      return true;
  }
}

Group Group::group(const std::string& name) const {
  return {Handle(H5Gopen2(id(), name.c_str(), H5P_DEFAULT), H5Gclose), name_ + "/" + name, place_};
}

Dataset Group::dataset(const std::string& name) const {
  return {Handle(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose), name_ + "/" + name, place_};
}

Session::Session() {
  in_use.lock();
  H5Eget_auto2(H5E_DEFAULT, &printer_, &printer_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Session::~Session() {
  H5Eset_auto2(H5E_DEFAULT, printer_, printer_data_);
  in_use.unlock();
}

File::File(const std::filesystem::path& path)
    : Group(Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose), "",
            std::make_shared<const Place>(path, false)) {}

Format File::format() const {
  if (!has_attribute("format"))
    return {};
  return {text("format"), number<std::int32_t>("format_version")};
}

void write_file(const std::filesystem::path& path, const Format& format,
                const std::function<void(const Group& root)>& fill) {
  write_whole_file(path, [&](const std::filesystem::path& beside) {
    const Session session;
    errno = 0;
    struct Root : Group {
      Root(const std::filesystem::path& beside_in, const std::filesystem::path& path_in)
          : Group(Handle(H5Fcreate(beside_in.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose), "",
                  std::make_shared<const Place>(path_in, true)) {}
      void end() { demand(handle_.close() ? 0 : -1, ""); }
      void flush() const { demand(H5Fflush(id(), H5F_SCOPE_GLOBAL), ""); }
    } root(beside, path);
    root.set_text("format", format.name);
    root.set_number("format_version", format.version);
    fill(root);
    root.flush();
    root.end();
  });
}

} // namespace strainwave::hdf5
