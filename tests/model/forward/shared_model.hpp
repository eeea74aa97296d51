#pragma once
// One forward model for the tests of this folder: the seed's cup is solved once.

#include "strainwave/model/forward/forward.hpp"

namespace strainwave::testing_support {

inline ForwardModel& shared_model() {
  static ForwardModel model({.disk_cache = false});
  return model;
}

} // namespace strainwave::testing_support
