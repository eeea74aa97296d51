#pragma once
// From a node of a TOML file to a checked value of a gear's field. Faults are collected, so that a user sees
// all of them at once; a value with a fault is not written.

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/gear_file/toml_source.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

/// "the text "0.2"", "a list", "the number 3.5": what a file gave instead of what was expected.
std::string node_words(const toml::node& node);

/// A number, text or list of numbers as it stands; nothing for other nodes.
std::optional<FieldValue> plain_value(const toml::node& node);

/// The node as the field wants it, checked. `key` is the full path for messages.
std::optional<FieldValue> read_value(const Field& field, std::string_view key, const toml::node& node,
                                     std::vector<FileFault>& faults);

/// Writes one value into a gear: any path of the table, or one item of a list ("….spline_um[3]").
/// wave_generator.table_file is taken relative to `folder` and has to exist.
void apply_override(Gear& gear, std::string_view path, const toml::node& node, Place key_place,
                    const std::filesystem::path& folder, std::vector<FileFault>& faults);

/// Every key below `table` as an override, whether written "contact.gaps" = … or as tables.
void apply_overrides(Gear& gear, const toml::table& table, const std::filesystem::path& folder,
                     std::vector<FileFault>& faults);

} // namespace strainwave
