#pragma once
// TOML text in, toml++ table out, with its errors turned into FileErrors. For rooms that read files;
// everybody else includes gear_file.hpp, which knows no parser.

#include "strainwave/model/gear_file/file_error.hpp"

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace strainwave {

/// The whole file. Throws FileError if there is no such file or it cannot be a text file of ours,
/// std::system_error if the operating system refuses (permissions, disk). `kind` is for messages: "gear
/// file".
std::string read_text_file(const std::string& path, std::string_view kind);

/// Throws FileError, with one fault, where the text is no TOML or names a key twice.
toml::table parse_toml(std::string_view text, const std::string& name);

inline Place place_of(const toml::source_region& region) {
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}
inline Place place_of(const toml::node& node) {
  return place_of(node.source());
}
inline Place place_of(const toml::key& key) {
  return place_of(key.source());
}

} // namespace strainwave
