#pragma once
// Ipopt (A. Wächter, L. Biegler, Math. Program. 106, 2006) on the epigraph of the objective. A largest force
// has a kink wherever two teeth carry the same, and its minima lie just there; the forces themselves have
// none of these. So
//
//     minimise t   subject to   F_i(y) ≤ t for all teeth, phases and loads,   g_k(y) ≤ 0,   0 ≤ y ≤ upper,
//
// which a method for smooth problems can solve. Without pieces (evaluator.hpp), or when maximising, the
// objective itself is minimised. First derivatives are exact where the evaluator knows them, else central
// differences; second ones are Ipopt's limited-memory estimate. A point that cannot be evaluated is answered
// with `false`, as Ipopt expects: it shortens its step.
//
// Ipopt 3.11 with MUMPS is not thread-safe: one search at a time is inside the library. While a search waits
// for an evaluation of the model it lets the others in, so evaluations do run side by side.

#include "strainwave/optimize/methods/search.hpp"

#include <span>
#include <string_view>

namespace strainwave {

inline constexpr std::string_view ipopt_method = "ipopt";

/// False in a build without Ipopt (STRAINWAVE_IPOPT=OFF, see docs/licences.md).
bool ipopt_available();

/// Like search_nlopt. Throws std::logic_error in a build without Ipopt.
SearchResult search_ipopt(const Problem& problem, std::span<const double> y, const SearchSettings& settings,
                          Monitor& monitor);

} // namespace strainwave
