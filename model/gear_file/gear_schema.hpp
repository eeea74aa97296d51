#pragma once
// Descriptions of the gear file that are made from the table of fields: a JSON Schema for editors and other
// programs, and the reference page docs/gear-file.md for people.

#include "strainwave/model/gear/fields.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace strainwave {

/// JSON Schema, draft 2020-12, of the JSON image of a gear file's TOML. It knows types, ranges, choices and
/// required keys; that a file exists and that a list rises is beyond it.
nlohmann::ordered_json json_schema();

/// The reference page in Markdown.
std::string reference_page();

/// JSON Schema of one key; `default_value`: std::monostate for none. Also for tables other than the gear's.
nlohmann::ordered_json field_schema(const Field& field, const FieldValue& default_value);

/// "number, [0, 100)": what the reference pages say.
std::string allowed_words(const Field& field);

} // namespace strainwave
