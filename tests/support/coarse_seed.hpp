#pragma once
// The seed gear on meshes that solve in a moment: for tests of everything but the elements' own convergence.

#include "strainwave/model/gear/gear.hpp"

namespace strainwave::testing_support {

/// One analysis takes some 10 ms.
inline constexpr Mesh coarsest_mesh = {.per_pitch = 3,
                                       .along_face = 2,
                                       .along_wall = 2,
                                       .diaphragm = 1,
                                       .tooth_height = 1,
                                       .through_thickness = 1};
/// The wall and the face bend as they should, roughly.
inline constexpr Mesh coarse_mesh = {.per_pitch = 3,
                                     .along_face = 3,
                                     .along_wall = 4,
                                     .diaphragm = 3,
                                     .tooth_height = 1,
                                     .through_thickness = 1};
/// Two elements over the tooth's height: loads at several heights differ.
inline constexpr Mesh two_row_mesh = {.per_pitch = 3,
                                      .along_face = 4,
                                      .along_wall = 5,
                                      .diaphragm = 3,
                                      .tooth_height = 2,
                                      .through_thickness = 1};

inline Gear coarse_seed_gear(const Mesh& mesh = coarse_mesh) {
  Gear gear = seed_gear();
  gear.mesh = mesh;
  return gear;
}

} // namespace strainwave::testing_support
