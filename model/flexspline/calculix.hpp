#pragma once
// Export of the ring, or of a part of it, as a CalculiX deck (Abaqus keywords): C3D20R elements, the bore
// fixed, loads of functionals as consistent nodal forces, displacements of all nodes printed to the .dat
// file.
//
// CalculiX reads numbers in fields of at most 20 characters and silently cuts longer ones, so every number is
// written with 12 significant digits and what is below 1e-14 of the largest becomes 0. Displacements are
// printed with seven digits.

#include "strainwave/model/flexspline/ring.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace strainwave {

struct DeckLoad {
  Functional functional;
  int sector = 0;
  double factor = 1.0; ///< N (N·mm for rotations)
};

/// One step a load case. Writes to a stream; the caller checks it.
void write_calculix_deck(std::ostream& out, const RingPart& part, const Material& material,
                         const std::vector<std::vector<DeckLoad>>& cases, const std::string& title);

} // namespace strainwave
