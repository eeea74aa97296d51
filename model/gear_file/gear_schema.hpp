#pragma once
// Descriptions of the gear file that are made from the table of fields: a JSON Schema for editors and other
// programs, and the reference page docs/gear-file.md for people.

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace strainwave {

/// JSON Schema, draft 2020-12, of the JSON image of a gear file's TOML. It knows types, ranges, choices and
/// required keys; that a file exists and that a list rises is beyond it.
nlohmann::ordered_json json_schema();

/// The reference page in Markdown.
std::string reference_page();

} // namespace strainwave
