#include "strainwave/model/flexspline/response_store.hpp"

#include "strainwave/common/files/content_hash.hpp"
#include "strainwave/common/files/hdf5.hpp"

#include <bit>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>

namespace strainwave {

namespace {

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

template <class T>
std::uint32_t crc_of(const std::vector<T>& list, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const unsigned char*>(list.data()), list.size() * sizeof(T)));
}

/// CRC-32 of all numbers, as in journals.
std::uint64_t checksum(const UnitResponses& responses) {
  std::uint32_t sum = crc_of(single_numbers(responses));
  for (const auto& entry : lists)
    sum = crc_of(responses.*entry.list, sum);
  return sum;
}

/// What a file holds, checked against itself; nothing where it is damaged.
std::optional<UnitResponses> read_responses(const hdf5::File& file) {
  const auto check = file.dataset("checksum").read<std::uint64_t>();
  const auto numbers = file.dataset("numbers").read<double>();
  if (check.size() != 1 || numbers.size() != 4)
    return {};
  UnitResponses responses;
  for (const auto& entry : lists)
    responses.*entry.list = file.dataset(entry.name).read<double>();
  responses.sectors = static_cast<int>(numbers[0]);
  responses.reciprocity_error = numbers[1];
  responses.discretisation_estimate = numbers[2];
  responses.both_flanks = numbers[3] != 0.0;
  const auto count = static_cast<std::size_t>(responses.count());
  if (responses.data.size() != static_cast<std::size_t>(responses.sectors) * count * count ||
      checksum(responses) != check.front())
    return {};
  return responses;
}

} // namespace

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
  const std::string_view bytes(reinterpret_cast<const char*>(key.data()), key.size() * sizeof key[0]);
  return folder / fmt::format("unit-responses-{}.h5", hash_text(content_hash(bytes)));
}

std::optional<UnitResponses> ResponseStore::find(const ResponseRequest& request) const {
  std::error_code error;
  const std::filesystem::path path = file(request);
  if (folder.empty() || !std::filesystem::exists(path, error))
    return {};
  const char* flaw = "it cannot be read as HDF5";
  try {
    const hdf5::File stored(path);
    flaw = "it holds no key of a flexspline";
    const auto key = stored.dataset("key").read<std::uint64_t>();
    flaw = "it is damaged";
    if (key != response_key(request))
      flaw = "it belongs to another flexspline or an older version";
    else if (auto responses = read_responses(stored))
      return responses;
  } catch (const std::system_error&) { // the flaw says what was being read
  }
  warn(fmt::format("{} is ignored: {}; the unit responses are computed again", path.string(), flaw));
  return {};
}

void ResponseStore::keep(const ResponseRequest& request, const UnitResponses& responses) const {
  if (folder.empty())
    return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  try {
    hdf5::write_file(file(request), {"strainwave unit responses", 1}, [&](const hdf5::Group& stored) {
      stored.put("key", response_key(request));
      stored.put("checksum", std::vector{checksum(responses)});
      stored.put("numbers", single_numbers(responses));
      for (const auto& entry : lists)
        stored.put(entry.name, responses.*entry.list).set_text("units", entry.unit);
    });
  } catch (const std::system_error& refused) {
    warn(fmt::format("the unit responses cannot be kept in {}: {}; they will be computed again next time",
                     folder.string(), refused.code().message()));
  }
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
