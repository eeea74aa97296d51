#pragma once
// A file that appears whole or not at all: written beside its name as NAME.part, renamed into place by
// commit(). Without commit() nothing stays behind and an older file of that name is untouched.

#include <filesystem>
#include <fstream>
#include <string_view>

namespace strainwave {

class ReplacedFile {
public:
  /// Throws std::system_error with the path and the cause.
  explicit ReplacedFile(std::filesystem::path path);
  ~ReplacedFile();
  ReplacedFile(const ReplacedFile&) = delete;
  ReplacedFile& operator=(const ReplacedFile&) = delete;

  std::ostream& stream() { return out; }
  /// Throws std::system_error when the disk did not take everything.
  void commit();

private:
  std::filesystem::path target, beside;
  std::ofstream out;
};

/// The same for a whole text.
void replace_file(const std::filesystem::path& path, std::string_view text);

/// Throws std::system_error "cannot write PATH" with errno, or EIO when it is 0.
[[noreturn]] void cannot_write(const std::filesystem::path& path, int error);

} // namespace strainwave
