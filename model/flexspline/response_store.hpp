#pragma once
// Unit responses on disk, by content: the same cup is solved once.
//
// The key is the canonical bits of everything a ResponseRequest says, plus the version of this stage; a file
// is named by the key's hash and holds the whole key, which is compared on reading. Files are written beside
// and renamed, so a reader never sees half of one. A damaged, foreign or old file, and a folder that cannot
// be written, are a warning and the responses are computed: the store never changes a result. Format: HDF5,
// with a checksum of the numbers.

#include "strainwave/model/flexspline/responses.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace strainwave {

/// Raised whenever the same request would give other numbers.
inline constexpr std::uint64_t response_stage_version = 4;

/// Canonical bits of a request (every number as 64 bits, lists with their length) behind the stage's version.
std::vector<std::uint64_t> response_key(const ResponseRequest& request);

/// $STRAINWAVE_CACHE, else $XDG_CACHE_HOME/strainwave, else ~/.cache/strainwave; empty when there is no home
/// either.
std::filesystem::path cache_folder();

class ResponseStore {
public:
  using Warning = std::function<void(const std::string& sentence)>;
  /// An empty folder: no store; nothing is found, nothing is kept.
  explicit ResponseStore(std::filesystem::path folder = cache_folder(), Warning warning = {});

  std::filesystem::path file(const ResponseRequest& request) const;
  std::optional<UnitResponses> find(const ResponseRequest& request) const;
  void keep(const ResponseRequest& request, const UnitResponses& responses) const;

private:
  void warn(const std::string& sentence) const;
  std::filesystem::path folder;
  Warning warning;
};

/// Responses and where they came from.
struct StoredResponses {
  UnitResponses responses;
  bool reused = false; ///< read from disk
};

/// From the store, or computed and kept there.
Outcome<StoredResponses> stored_unit_responses(const ResponseRequest& request, const ResponseStore& store,
                                               int threads = 0);

} // namespace strainwave
