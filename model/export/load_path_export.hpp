#pragma once
// A load path as JSON and HDF5; keys and units are in docs/results.md.

#include "strainwave/common/files/hdf5.hpp"
#include "strainwave/model/results/load_path.hpp"

#include <nlohmann/json_fwd.hpp>

namespace strainwave {

nlohmann::ordered_json load_path_json(const LoadPath& path);

/// As the group "path" of `parent`: events and changes as columns; a change has the number of its event.
void put_load_path(const LoadPath& path, const hdf5::Group& parent);

} // namespace strainwave
