#pragma once
// Searches by NLopt (S. G. Johnson, The NLopt nonlinear-optimization package).
//
// The library is C: an exception must not pass through it. One that arises in a callback is kept, the library
// is told to stop, and the exception goes on its way when the library has returned.
//
// NLopt's random numbers belong to the thread; they are seeded by `seed` at the start of every search, in its
// own thread.

#include "strainwave/optimize/methods/search.hpp"

#include <span>
#include <string_view>

namespace strainwave {

/// Names of the methods, for study files.
std::span<const std::string_view> nlopt_method_names();

/// `y` lies within the scaled bounds. Throws what the evaluator throws.
SearchResult search_nlopt(const Problem& problem, std::span<const double> y, const SearchSettings& settings,
                          Monitor& monitor);

} // namespace strainwave
