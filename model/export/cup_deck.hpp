#pragma once
// A CalculiX deck of the whole cup: the same mesh, material and loads as the program's own finite elements,
// so that another program can be asked the same question. One static step for each load.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/flexspline/functionals.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/loading/contact_forces.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace strainwave {

/// 1 N on the drive flank of one tooth, spread over the face, by the hats that contact uses (flank_height
/// between two hats: shared linearly).
struct UnitToothLoad {
  int tooth = 0;
  double flank_height = 0.5; ///< 0 root circle, 1 tip
  bool radial = false;       ///< outwards; else circumferential, towards larger φ
};

/// The deck's header names gear, mesh and load. Failures: contradictions of gear, mesh or load.
Outcome<std::string> calculix_deck(const Gear& gear, const UnitToothLoad& load);

/// The contact forces of each state as one step.
Outcome<std::string> calculix_deck(const Gear& gear, const ContactStates& states);

} // namespace strainwave
