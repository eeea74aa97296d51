#include "model/export/replaced_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace strainwave {

void cannot_write(const std::filesystem::path& path, int error) {
  throw std::system_error(error != 0 ? error : EIO, std::generic_category(),
                          fmt::format("cannot write {}", path.string()));
}

ReplacedFile::ReplacedFile(std::filesystem::path path)
    : target(std::move(path)), beside(target.string() + ".part") {
  if (std::filesystem::is_directory(target))
    cannot_write(target, EISDIR);
  errno = 0;
  out.open(beside, std::ios::binary | std::ios::trunc);
  if (!out)
    cannot_write(target, errno);
}

ReplacedFile::~ReplacedFile() {
  if (!out.is_open())
    return;
  out.close();
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
}

void ReplacedFile::commit() {
  errno = 0;
  out.flush();
  if (!out)
    cannot_write(target, errno);
  out.close();
  std::error_code error;
  std::filesystem::rename(beside, target, error);
  if (error)
    cannot_write(target, error.value());
}

void replace_file(const std::filesystem::path& path, std::string_view text) {
  ReplacedFile file(path);
  file.stream() << text;
  file.commit();
}

} // namespace strainwave
