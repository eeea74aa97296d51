#pragma once
// Gear files: TOML in, a checked Gear out, and back. What may stand in a file is the table of
// model/gear/fields.hpp and docs/gear-file.md, which is made from it.
//
//     GearDocument document = load_gear("seed.toml");     // throws FileError with all faults of the file
//     std::string complete = write_gear(document.gear);   // every default filled in; reads back bit for bit

#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/gear_file/file_error.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

struct GearDocument {
  Gear gear;
  std::string file;
  std::map<std::string, Place, std::less<>> places; ///< of the keys that the file gives, by path

  /// One sentence with its place for each value by a former name.
  std::vector<std::string> warnings;

  /// "seed.toml:12:1" for a key of the file, "seed.toml" for one that has its default.
  std::string where(std::string_view path) const;
};

/// Throws FileError (the user's fault), std::system_error (permissions, disk).
GearDocument load_gear(const std::string& path);

/// `name` stands in messages; relative files in the text are looked for beside it.
GearDocument parse_gear(std::string_view text, const std::string& name);

/// The gear as a TOML file with every key, its unit, range and meaning; keys without a value are shown behind
/// "#".
std::string write_gear(const Gear& gear);

} // namespace strainwave
