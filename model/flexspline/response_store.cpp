#include "strainwave/model/flexspline/response_store.hpp"

#include <atomic>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

namespace strainwave {

namespace {

/// An HDF5 identifier that closes itself; negative: failed.
class Handle {
public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : identifier(id), closer(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { (void)release(); }
  bool ok() const { return identifier >= 0; }
  hid_t id() const { return identifier; }
  /// Closes now; false when that fails (a full disk shows here).
  bool release() {
    if (identifier < 0)
      return true;
    return closer(std::exchange(identifier, -1)) >= 0;
  }

private:
  hid_t identifier;
  herr_t (*closer)(hid_t);
};

/// Debian's HDF5 is not built for several threads: one store works at a time.
std::mutex hdf5_in_use;

/// HDF5 prints its error stack by default; here a failed call is an ordinary answer.
class QuietErrors {
public:
  QuietErrors() {
    H5Eget_auto2(H5E_DEFAULT, &handler, &data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, handler, data); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

private:
  H5E_auto2_t handler = nullptr;
  void* data = nullptr;
};

hid_t memory_type(double) {
  return H5T_NATIVE_DOUBLE;
}
hid_t memory_type(std::uint64_t) {
  return H5T_NATIVE_UINT64;
}
hid_t file_type(double) {
  return H5T_IEEE_F64LE;
}
hid_t file_type(std::uint64_t) {
  return H5T_STD_U64LE;
}

template <class T>
bool write_list(hid_t file, const char* name, const std::vector<T>& values, const char* unit = nullptr) {
  const hsize_t size = values.size();
  Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  Handle set(H5Dcreate2(file, name, file_type(T{}), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             H5Dclose);
  if (!set.ok())
    return false;
  if (size > 0 && H5Dwrite(set.id(), memory_type(T{}), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    return false;
  if (unit != nullptr) {
    Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
    Handle scalar(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(text.id(), std::strlen(unit));
    Handle attribute(H5Acreate2(set.id(), "unit", text.id(), scalar.id(), H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose);
    if (!attribute.ok() || H5Awrite(attribute.id(), text.id(), unit) < 0)
      return false;
  }
  return set.release();
}

template <class T>
bool read_list(hid_t file, const char* name, std::vector<T>& values) {
  Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  if (!set.ok())
    return false;
  Handle space(H5Dget_space(set.id()), H5Sclose);
  if (H5Sget_simple_extent_ndims(space.id()) != 1)
    return false;
  const hssize_t size = H5Sget_simple_extent_npoints(space.id());
  if (size < 0 || static_cast<hsize_t>(size) * sizeof(T) > H5Dget_storage_size(set.id()))
    return false;
  values.resize(static_cast<std::size_t>(size));
  return size == 0 || H5Dread(set.id(), memory_type(T{}), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
}

constexpr struct {
  const char* name;
  const char* unit;
  std::vector<double> UnitResponses::*list;
} lists[] = {{"flank_radius", "mm", &UnitResponses::flank_radius_mm},
             {"flank_centre", "mm", &UnitResponses::flank_centre_mm},
             {"flank_z", "mm", &UnitResponses::flank_z_mm},
             {"wall_offset", "pitch", &UnitResponses::wall_offset},
             {"wall_z", "mm", &UnitResponses::wall_z_mm},
             {"section_z", "mm", &UnitResponses::section_z_mm},
             {"responses", "mm/N", &UnitResponses::data}};

/// What is no list: sectors, reciprocity error, discretisation estimate, both flanks or the drive flank
/// alone.
std::vector<double> single_numbers(const UnitResponses& responses) {
  return {static_cast<double>(responses.sectors), responses.reciprocity_error,
          responses.discretisation_estimate, responses.both_flanks ? 1.0 : 0.0};
}

std::uint64_t hash_of(const std::vector<double>& list) {
  std::vector<std::uint64_t> words(list.size());
  if (!list.empty())
    std::memcpy(words.data(), list.data(), list.size() * sizeof(double));
  return content_hash(words.data(), words.size());
}

std::uint64_t checksum(const UnitResponses& responses) {
  std::uint64_t sum = hash_of(single_numbers(responses));
  for (const auto& entry : lists) {
    const std::uint64_t both[2] = {sum, hash_of(responses.*entry.list)};
    sum = content_hash(both, 2);
  }
  return sum;
}

} // namespace

std::uint64_t content_hash(const std::uint64_t* words, std::size_t count) {
  std::uint64_t hash = 14695981039346656037u;
  for (std::size_t n = 0; n < count; ++n)
    hash = (hash ^ words[n]) * 1099511628211u, hash ^= hash >> 29;
  hash ^= hash >> 33; // final mix of MurmurHash3 (Appleby, public domain)
  hash *= 0xff51afd7ed558ccdu;
  hash ^= hash >> 33;
  return hash;
}

std::vector<std::uint64_t> response_key(const ResponseRequest& r) {
  std::vector<std::uint64_t> key = {response_stage_version};
  const auto real = [&](double value) {
    key.push_back(std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value));
  };
  const auto whole = [&](long long value) { key.push_back(static_cast<std::uint64_t>(value)); };
  const auto list = [&](const std::vector<double>& values) {
    whole(static_cast<long long>(values.size()));
    for (const double value : values)
      real(value);
  };
  const Flexspline& f = r.flexspline;
  for (const double value : {f.module_mm, f.pressure_angle_deg, f.profile_shift, f.tip_radius_mm,
                             f.root_radius_mm, f.neutral_radius_mm, f.rim_thickness_mm, f.wall_thickness_mm,
                             f.cup_length_mm, f.face_width_mm, f.front_clearance_mm, f.diaphragm_thickness_mm,
                             f.boss_radius_mm, r.material.youngs_modulus_mpa, r.material.poisson_ratio})
    real(value);
  for (const int value :
       {f.teeth, r.mesh.per_pitch, r.mesh.along_face, r.mesh.along_wall, r.mesh.diaphragm,
        r.mesh.tooth_height, r.mesh.through_thickness, r.teeth ? 1 : 0, r.sectors, r.flank_heights,
        r.face_slices, r.both_flanks ? 1 : 0, r.sections ? 1 : 0, r.estimate ? 1 : 0})
    whole(value);
  list(r.wall_offset);
  list(r.wall_z_mm);
  list(r.section_z_mm);
  return key;
}

std::filesystem::path cache_folder() {
  const auto variable = [](const char* name) -> std::filesystem::path {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
  };
  if (const auto own = variable("STRAINWAVE_CACHE"); !own.empty())
    return own;
  // The XDG specification has relative paths ignored.
  if (const auto xdg = variable("XDG_CACHE_HOME"); xdg.is_absolute())
    return xdg / "strainwave";
  if (const auto home = variable("HOME"); !home.empty())
    return home / ".cache" / "strainwave";
  return {};
}

ResponseStore::ResponseStore(std::filesystem::path where, Warning on_warning)
    : folder(std::move(where)), warning(std::move(on_warning)) {}

void ResponseStore::warn(const std::string& sentence) const {
  if (warning)
    warning(sentence);
}

std::filesystem::path ResponseStore::file(const ResponseRequest& request) const {
  const std::vector<std::uint64_t> key = response_key(request);
  return folder / fmt::format("unit-responses-{:016x}.h5", content_hash(key.data(), key.size()));
}

std::optional<UnitResponses> ResponseStore::find(const ResponseRequest& request) const {
  std::error_code error;
  const std::filesystem::path path = file(request);
  if (folder.empty() || !std::filesystem::exists(path, error))
    return {};
  const std::lock_guard lock(hdf5_in_use);
  const QuietErrors quiet;
  const auto ignored = [&](const char* reason) -> std::optional<UnitResponses> {
    warn(fmt::format("{} is ignored: {}; the unit responses are computed again", path.string(), reason));
    return {};
  };
  Handle handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!handle.ok())
    return ignored("it cannot be read as HDF5");
  std::vector<std::uint64_t> key, check;
  std::vector<double> numbers;
  if (!read_list(handle.id(), "key", key))
    return ignored("it holds no key of a flexspline");
  if (key != response_key(request))
    return ignored("it belongs to another flexspline or an older version");
  UnitResponses responses;
  bool whole = read_list(handle.id(), "checksum", check) && check.size() == 1 &&
               read_list(handle.id(), "numbers", numbers) && numbers.size() == 4;
  for (const auto& entry : lists)
    whole = whole && read_list(handle.id(), entry.name, responses.*entry.list);
  if (!whole)
    return ignored("it is damaged");
  responses.sectors = static_cast<int>(numbers[0]);
  responses.reciprocity_error = numbers[1];
  responses.discretisation_estimate = numbers[2];
  responses.both_flanks = numbers[3] != 0.0;
  const auto count = static_cast<std::size_t>(responses.count());
  if (responses.data.size() != static_cast<std::size_t>(responses.sectors) * count * count ||
      checksum(responses) != check.front())
    return ignored("it is damaged");
  return responses;
}

void ResponseStore::keep(const ResponseRequest& request, const UnitResponses& responses) const {
  if (folder.empty())
    return;
  static std::atomic<unsigned> serial = 0;
  const std::filesystem::path path = file(request);
  std::filesystem::path beside = path;
  beside += fmt::format(".{}-{}.part", getpid(), serial++);
  const std::lock_guard lock(hdf5_in_use);
  const QuietErrors quiet;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  bool done = false;
  {
    Handle handle(H5Fcreate(beside.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    done = handle.ok() && write_list(handle.id(), "key", response_key(request)) &&
           write_list(handle.id(), "checksum", std::vector<std::uint64_t>{checksum(responses)}) &&
           write_list(handle.id(), "numbers", single_numbers(responses));
    for (const auto& entry : lists)
      done = done && write_list(handle.id(), entry.name, responses.*entry.list, entry.unit);
    done = handle.release() && done;
  }
  if (done)
    std::filesystem::rename(beside, path, error);
  if (done && !error)
    return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  warn(fmt::format("the unit responses cannot be kept in {}{}; they will be computed again next time",
                   folder.string(), error ? ": " + error.message() : ""));
}

Outcome<StoredResponses> stored_unit_responses(const ResponseRequest& request, const ResponseStore& store,
                                               int threads) {
  if (auto found = store.find(request))
    return StoredResponses{std::move(*found), true};
  Outcome<UnitResponses> computed = unit_responses(request, threads);
  if (!computed)
    return computed.failure();
  StoredResponses result = {std::move(computed).value(), false};
  store.keep(request, result.responses);
  return result;
}

} // namespace strainwave
