#pragma once
// Files that are either there as a whole or not at all: written beside, synced to the disk, renamed.

#include <filesystem>
#include <functional>
#include <string_view>

namespace strainwave {

/// Makes a rename or a new file in the folder of `path` last. Throws std::system_error.
void sync_folder_of(const std::filesystem::path& path);

/// `write` fills the file it is given (a name beside `path`); then it is synced and renamed to `path`.
/// Whatever throws, a file that was there stays as it was and nothing is left beside it. Throws
/// std::system_error and what `write` throws.
void write_whole_file(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

void write_whole_text(const std::filesystem::path& path, std::string_view text);

} // namespace strainwave
