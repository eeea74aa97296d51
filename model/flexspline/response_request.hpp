#pragma once
// What the finite elements read of a gear: cup, material, mesh and where the flank is loaded. Nothing of the
// wave generator, so no change of it makes them run again.

#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/model/gear/gear.hpp"

namespace strainwave {

ResponseRequest response_request(const Gear& gear);

/// Rows of the mesh on which the wall's responses are known stand this far apart, mm.
double row_spacing_mm(const Gear& gear);

} // namespace strainwave
