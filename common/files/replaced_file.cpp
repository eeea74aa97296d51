#include "strainwave/common/files/replaced_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace strainwave {

void cannot_write(const std::filesystem::path& path, int error) {
  throw std::system_error(error != 0 ? error : EIO, std::generic_category(),
                          fmt::format("cannot write {}", path.string()));
}

void replace_file(const std::filesystem::path& path, std::string_view text) {
  if (std::filesystem::is_directory(path))
    cannot_write(path, EISDIR);
  const std::filesystem::path beside = path.string() + ".part";
  errno = 0;
  std::FILE* file = std::fopen(beside.c_str(), "wb");
  if (file == nullptr)
    cannot_write(path, errno);
  bool whole = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  int error = errno;
  if (std::fclose(file) != 0 && whole) {
    whole = false;
    error = errno;
  }
  std::error_code renamed;
  if (whole)
    std::filesystem::rename(beside, path, renamed);
  if (whole && !renamed)
    return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  cannot_write(path, whole ? renamed.value() : error);
}

} // namespace strainwave
