#pragma once
// A file that appears whole or not at all: written beside its name as NAME.part, then renamed into place.
// When that fails nothing stays behind and an older file of that name is untouched.

#include <filesystem>
#include <string_view>

namespace strainwave {

/// Throws std::system_error "cannot write PATH" with the cause.
void replace_file(const std::filesystem::path& path, std::string_view text);

/// Throws that error with errno `error`, or EIO when it is 0.
[[noreturn]] void cannot_write(const std::filesystem::path& path, int error);

} // namespace strainwave
