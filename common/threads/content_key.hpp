#pragma once
// The content of an input as a key: the exact bits that a computation reads, and nothing else. So nothing
// runs again for a change that it does not see, and nothing is reused for one that it does.

#include <compare>
#include <cstring>
#include <string>
#include <string_view>

namespace strainwave {

/// Exact bits of numbers and texts, in order; −0 counts as 0.
class ContentKey {
public:
  ContentKey& add(double value) {
    if (value == 0.0)
      value = 0.0;
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    bits_.append(bytes, sizeof value);
    return *this;
  }
  ContentKey& add(std::string_view text) {
    add(static_cast<double>(text.size()));
    bits_.append(text);
    return *this;
  }
  const std::string& bits() const { return bits_; }
  auto operator<=>(const ContentKey&) const = default;

private:
  std::string bits_;
};

} // namespace strainwave
