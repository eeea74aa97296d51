#pragma once
// A folder to export into and the seed gear on a mesh that solves in a moment.

#include "strainwave/model/gear/gear.hpp"
#include "tests/support/coarse_seed.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fstream>
#include <string>

namespace strainwave::testing_export {

using testing_support::TemporaryFolder;
using testing_support::text_of;

inline Gear coarse_seed() {
  Gear gear = testing_support::coarse_seed_gear();
  gear.load.torque_nm = {1.0, 7.0};
  gear.load.rotation_rad = {};
  return gear;
}

} // namespace strainwave::testing_export
