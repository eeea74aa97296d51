#pragma once
// Where several searches begin: the first at the study's start, the others spread over the box by a sequence
// without gaps and clusters (R_d of M. Roberts: steps by powers of 1/g with g^(d+1) = g + 1), shifted by the
// seed. Point k depends on k, the seed and the number of variables alone, so a longer list begins with
// a shorter one.

#include "strainwave/optimize/problem/design.hpp"

#include <cstdint>
#include <vector>

namespace strainwave {

/// Scaled coordinates.
std::vector<std::vector<double>> start_points(const DesignSpace& design, std::size_t count,
                                              std::uint64_t seed);

} // namespace strainwave
