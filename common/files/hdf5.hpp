#pragma once
// HDF5 files, written and read: groups, datasets of numbers and texts, attributes, dimension scales.
//
//     hdf5::write_file("result.h5", {"strainwave result", 1}, [&](const hdf5::Group& root) {
//       const hdf5::Group load = root.make_group("load");
//       const hdf5::Dataset phi = load.put("phi", phi_deg);          // one axis
//       phi.set_text("units", "deg");
//       phi.make_scale("phi");
//       load.put("force", force_n, {loads, teeth}).attach_scale(1, phi);
//     });
//
//     const hdf5::File file("result.h5");
//     const std::vector<double> force = file.dataset("load/force").read<double>();
//
// Matrices are row by row. Numbers are little-endian, texts UTF-8 of any length (a reader finds texts of
// fixed length too). Files carry no times, so the same content gives the same bytes; what is written is there
// as a whole or not at all (whole_file.hpp). Datasets are not compressed.
//
// Debian's HDF5 is not built for several threads: whoever has a file open, to read or to write, holds one
// lock of the process. Keep files open for as long as it takes to read them, and in one thread.
//
// Errors: std::system_error "cannot write PATH (/load/force)" with the cause; "cannot read PATH
// (/load/force)" with EIO where the file holds something else.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strainwave::hdf5 {

enum class NumberType { float64, int32, int64, uint8, uint64 };

template <class T>
struct NumberTypeOf;
template <>
struct NumberTypeOf<double> {
  static constexpr NumberType value = NumberType::float64;
};
template <>
struct NumberTypeOf<std::int32_t> {
  static constexpr NumberType value = NumberType::int32;
};
template <>
struct NumberTypeOf<std::int64_t> {
  static constexpr NumberType value = NumberType::int64;
};
template <>
struct NumberTypeOf<std::uint8_t> {
  static constexpr NumberType value = NumberType::uint8;
};
template <>
struct NumberTypeOf<std::uint64_t> {
  static constexpr NumberType value = NumberType::uint64;
};
template <class T>
inline constexpr NumberType number_type = NumberTypeOf<T>::value;

/// Lengths of the axes; {}: one number.
using Shape = std::vector<std::size_t>;

/// An identifier of HDF5 that closes itself.
class Handle {
public:
  using Closer = int (*)(std::int64_t);
  Handle() = default;
  Handle(std::int64_t id, Closer close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() { (void)close(); }
  std::int64_t id() const { return id_; }
  /// Now; false when that fails: a full disk may show only here.
  bool close() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

private:
  std::int64_t id_ = -1;
  Closer close_ = nullptr;
};

/// Which file an object is in, for messages.
struct Place {
  std::filesystem::path file;
  bool written = false; ///< else read
};

/// A group or a dataset: carries attributes.
class Object {
public:
  void set_text(const std::string& attribute, std::string_view text) const;
  /// Of fixed length and no other than ASCII, for readers that compare bytes (VTKHDF).
  void set_ascii(const std::string& attribute, const std::string& text) const;
  void set_texts(const std::string& attribute, std::span<const std::string> texts) const;
  template <class T>
  void set_number(const std::string& attribute, T number) const {
    set_numbers(attribute, number_type<T>, &number, nullptr);
  }
  template <class T>
  void set_numbers(const std::string& attribute, const std::vector<T>& numbers) const {
    const std::size_t count = numbers.size();
    set_numbers(attribute, number_type<T>, numbers.data(), &count);
  }

  bool has_attribute(const std::string& attribute) const;
  std::string text(const std::string& attribute) const;
  std::vector<std::string> texts(const std::string& attribute) const;
  template <class T>
  T number(const std::string& attribute) const {
    T value{};
    read_number(attribute, number_type<T>, &value);
    return value;
  }

  std::int64_t id() const { return handle_.id(); }

protected:
  Object(Handle handle, std::string name, std::shared_ptr<const Place> place);
  [[noreturn]] void refuse(const std::string& name) const;
  template <class Code>
  Code demand(Code code, const std::string& name) const {
    if (code < 0)
      refuse(name);
    return code;
  }
  Handle handle_;
  std::string name_; ///< from the root, "" for the root itself
  std::shared_ptr<const Place> place_;

private:
  void set_numbers(const std::string& attribute, NumberType, const void* numbers,
                   const std::size_t* count) const;
  void read_number(const std::string& attribute, NumberType, void* number) const;
};

class Dataset : public Object {
public:
  Shape shape() const;
  std::size_t size() const;
  /// All numbers, in order. A dataset that claims more than its file holds is refused.
  template <class T>
  std::vector<T> read() const {
    std::vector<T> numbers(demand_stored(number_type<T>));
    read_all(number_type<T>, numbers.data());
    return numbers;
  }
  std::vector<std::string> read_texts() const;
  std::string read_text() const; ///< of a dataset of one text

  /// Rows first … of a matrix.
  void write_rows(std::size_t first, std::span<const double> rows) const;

  /// Makes this the scale of an axis of other datasets.
  void make_scale(const std::string& name) const;
  void attach_scale(unsigned axis, const Dataset& scale) const;

private:
  friend class Group;
  Dataset(Handle handle, std::string name, std::shared_ptr<const Place> place)
      : Object(std::move(handle), std::move(name), std::move(place)) {}
  std::size_t demand_stored(NumberType) const;
  void read_all(NumberType, void* numbers) const;
  void write_all(NumberType, const void* numbers) const;
};

class Group : public Object {
public:
  Group make_group(const std::string& name) const;
  template <class T>
  Dataset make_dataset(const std::string& name, const Shape& shape) const {
    return make_dataset(name, number_type<T>, shape);
  }
  /// Vectors, arrays, spans of numbers; with one axis where no shape is given.
  template <std::ranges::contiguous_range Numbers>
  Dataset put(const std::string& name, const Numbers& numbers, const Shape& shape) const {
    return put(name, number_type<std::ranges::range_value_t<Numbers>>, std::ranges::data(numbers),
               std::ranges::size(numbers), shape);
  }
  template <std::ranges::contiguous_range Numbers>
  Dataset put(const std::string& name, const Numbers& numbers) const {
    return put(name, numbers, {std::ranges::size(numbers)});
  }
  template <class T>
  Dataset put_number(const std::string& name, T number) const {
    return put(name, number_type<T>, &number, 1, {});
  }
  Dataset put_text(const std::string& name, std::string_view text) const;
  Dataset put_texts(const std::string& name, std::span<const std::string> texts) const;

  /// Names may be paths below this group.
  bool has(const std::string& name) const;
  Group group(const std::string& name) const;
  Dataset dataset(const std::string& name) const;

protected:
  Group(Handle handle, std::string name, std::shared_ptr<const Place> place)
      : Object(std::move(handle), std::move(name), std::move(place)) {}

private:
  Dataset make_dataset(const std::string& name, NumberType, const Shape&) const;
  Dataset put(const std::string& name, NumberType, const void* numbers, std::size_t count,
              const Shape&) const;
};

/// The lock, and HDF5's own printing of errors switched off.
class Session {
public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

private:
  int (*printer_)(std::int64_t, void*) = nullptr;
  void* printer_data_ = nullptr;
};

/// What a file says about itself in the attributes "format" and "format_version" of its root.
struct Format {
  std::string name;
  std::int32_t version = 0; ///< from 1; raised when a reader of the older one would go wrong
};

/// A file to read: its root group. Outlives what was taken from it.
class File : private Session, public Group {
public:
  explicit File(const std::filesystem::path& path);
  Format format() const; ///< {"", 0} where it says nothing
};

/// Whole or not at all.
void write_file(const std::filesystem::path& path, const Format& format,
                const std::function<void(const Group& root)>& fill);

} // namespace strainwave::hdf5
