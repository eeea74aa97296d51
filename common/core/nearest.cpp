#include "strainwave/common/core/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace strainwave {

namespace {

char folded(char letter) {
  if (letter == '-' || letter == ' ')
    return '_';
  return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

bool lacks_ending(std::string_view wrong, std::string_view whole) {
  if (wrong.size() < 3 || wrong.size() >= whole.size())
    return false;
  return std::equal(wrong.begin(), wrong.end(), whole.begin(),
                    [](char a, char b) { return folded(a) == folded(b); });
}

} // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the usual table: before the previous, previous and current letter of a.
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = folded(a[i - 1]) == folded(b[j - 1]);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && folded(a[i - 1]) == folded(b[j - 2]) && folded(a[i - 2]) == folded(b[j - 1]);
      if (swapped)
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

Nearest nearest_name(std::string_view wrong, std::span<const std::string_view> candidates) {
  constexpr std::size_t longest = 200; // a key of megabytes is rubbish, not a slip
  Nearest best;
  for (const std::string_view candidate : candidates) {
    const std::size_t distance =
        lacks_ending(wrong, candidate) ? 1 : edit_distance(wrong.substr(0, longest), candidate);
    if (best.name.empty() || distance < best.distance)
      best = {candidate, distance, false};
  }
  const std::size_t tolerated = std::max<std::size_t>(2, std::min(wrong.size(), longest) / 3);
  best.close = !best.name.empty() && best.distance <= tolerated && best.distance < best.name.size();
  return best;
}

} // namespace strainwave
