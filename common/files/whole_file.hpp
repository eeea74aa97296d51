#pragma once
// Files that are there as a whole or not at all: written beside their place under a name that nobody else
// uses, synced to the disk, renamed into place. Whatever goes wrong, an older file of that name stays as it
// was and nothing is left beside it; only a process that is killed leaves its NAME.PID-N.part.
//
// A symbolic link stays a link: the file that it names is replaced. Into devices and pipes texts are written
// as they are. New files have the permissions that the umask leaves.
//
// Errors: std::system_error "cannot write PATH" with the cause.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

namespace strainwave {

void write_whole_text(const std::filesystem::path& path, std::string_view text);

/// `write` fills the file that it is given, which is there and empty; it must not put another in its place.
/// Throws what `write` throws, too.
void write_whole_file(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& beside)>& write);

/// Fails where one of these would, before anything is computed; leaves nothing behind.
void try_to_write(const std::filesystem::path& path);

/// All bytes, past interruptions and short writes; false (errno says why) where that fails.
bool write_all(int descriptor, std::span<const std::byte> bytes);

/// Makes a rename or a new file in the folder of `path` last.
void sync_folder_of(const std::filesystem::path& path);

} // namespace strainwave
