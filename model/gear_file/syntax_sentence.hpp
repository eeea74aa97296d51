#pragma once
// Words for a line that is no TOML. Most authors of gear files are no programmers, so the usual slips
// (decimal comma, text without quotes, a unit after the number, a foreign comment sign) are recognised by the
// line itself.

#include "strainwave/model/gear_file/file_error.hpp"

#include <string>
#include <string_view>

namespace strainwave {

/// `description` is toml++'s own message for the place.
FileFault syntax_fault(std::string_view text, Place place, std::string_view description);

} // namespace strainwave
