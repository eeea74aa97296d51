#pragma once
// One 64-bit number for a content: FNV-1a (Fowler, Noll, Vo). It tells plans and models apart by
// accident-proof odds (2^-64 for two of them); it is no protection against somebody who wants a collision.

#include <cstdint>
#include <string>
#include <string_view>

namespace strainwave {

std::uint64_t content_hash(std::string_view bytes);

/// 16 hexadecimal digits, as plan.json and messages show it.
std::string hash_text(std::uint64_t hash);

} // namespace strainwave
