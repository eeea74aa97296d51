#pragma once
// What is asked of a request for unit responses before it is solved. Internal to responses.cpp.

#include "strainwave/model/flexspline/responses.hpp"

#include <optional>

namespace strainwave {

/// Numbers that make no mesh or no functionals.
std::optional<Failure> find_flaw(const ResponseRequest& request);

/// Stiffness of thin walls falls with the cube of their thickness and that of a nearly incompressible
/// material grows beyond bounds; double precision ends near a spread of 10^15. Names the number that spreads
/// it most.
Failure ill_conditioned_cup(const ResponseRequest& request);

/// Memory that a solve takes at its peak, bytes, by the sizes of its largest arrays (element triplets and the
/// sparse matrix made of them; the condensed sector and the harmonics; spectrum and responses).
double response_memory_bytes(const ResponseRequest& request, int threads);

} // namespace strainwave
