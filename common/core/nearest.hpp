#pragma once
// Did you mean …? The legal name nearest to a misspelt one.
//
// Distance: Damerau–Levenshtein in its "optimal string alignment" form (F. Damerau, CACM 7, 1964): the least
// number of inserted, deleted, replaced letters and swapped neighbours. A name that merely lacks its ending
// ("module" for "module_mm") counts as one step, because forgotten units are the commonest slip in gear
// files. For names of a few dozen letters; do not use it on texts.

#include <cstddef>
#include <span>
#include <string_view>

namespace strainwave {

/// Number of single-letter steps from a to b. Upper and lower case, and - and _, count as the same letter.
std::size_t edit_distance(std::string_view a, std::string_view b);

struct Nearest {
  std::string_view name; ///< empty if there are no candidates
  std::size_t distance = 0;
  bool close = false; ///< near enough to ask "did you mean …?"
};

/// The candidate with the least distance; the first of equals.
Nearest nearest_name(std::string_view wrong, std::span<const std::string_view> candidates);

} // namespace strainwave
