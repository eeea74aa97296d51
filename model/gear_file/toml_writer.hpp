#pragma once
// Values and lines of TOML files that the program writes.

#include "strainwave/model/gear/fields.hpp"

#include <string>
#include <string_view>

namespace strainwave {

/// The value as TOML text that reads back to the same bits; an absent value has none and must not be passed.
std::string toml_value(const FieldValue& value);

/// A statement with its comment, the comments of a file one below the other.
std::string toml_line(const std::string& statement, std::string_view comment);

} // namespace strainwave
