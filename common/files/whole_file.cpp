#include "strainwave/common/files/whole_file.hpp"

#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace strainwave {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write(const fs::path& path, int error) {
  throw std::system_error(error != 0 ? error : EIO, std::generic_category(),
                          fmt::format("cannot write {}", path.string()));
}

/// A descriptor that closes itself; −1: none.
class Descriptor {
public:
  explicit Descriptor(int id) : id_(id) {}
  Descriptor(Descriptor&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (id_ >= 0)
      ::close(id_);
  }
  int id() const { return id_; }

private:
  int id_;
};

/// Where a link leads, over further links and also to what is not there yet; `path` itself where it is no
/// link.
fs::path target_of(fs::path path) {
  std::error_code unknown;
  for (int links = 0; fs::is_symlink(path, unknown); ++links) {
    if (links == 40)
      cannot_write(path, ELOOP);
    const fs::path next = fs::read_symlink(path, unknown);
    if (unknown)
      cannot_write(path, unknown.value());
    path = path.parent_path() / next; // an absolute one replaces the folder
  }
  return path;
}

/// A name beside the target that is not there yet. Numbers tell the threads of a process apart; on a shared
/// disk another machine may have a process of this number: then the next one.
struct PartFile {
  fs::path target, name;
  Descriptor file{-1};
};

PartFile part_of(const fs::path& path) {
  static std::atomic<unsigned> serial = 0;
  std::error_code unknown;
  const fs::path target = target_of(path);
  if (fs::is_directory(target, unknown))
    cannot_write(path, EISDIR);
  if (fs::exists(target, unknown) && !fs::is_regular_file(target, unknown))
    cannot_write(path, EINVAL);
  for (;;) {
    fs::path name = target.string() + fmt::format(".{}-{}.part", ::getpid(), serial++);
    Descriptor file(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.id() >= 0)
      return {target, std::move(name), std::move(file)};
    if (errno != EEXIST)
      cannot_write(path, errno);
  }
}

bool is_device(const fs::path& path) {
  std::error_code unknown;
  return fs::is_other(path, unknown); // through links
}

} // namespace

bool write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR)
      continue;
    if (done <= 0)
      return false;
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
  return true;
}

void sync_folder_of(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const Descriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // Some file systems cannot sync a folder and say so by EINVAL.
  if (file.id() < 0 || (::fsync(file.id()) != 0 && errno != EINVAL))
    cannot_write(path, errno);
}

void write_whole_file(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  const PartFile part = part_of(path);
  try {
    write(part.name);
    if (::fsync(part.file.id()) != 0)
      cannot_write(path, errno);
    std::error_code failed;
    fs::rename(part.name, part.target, failed);
    if (failed)
      cannot_write(path, failed.value());
  } catch (...) {
    std::error_code ignored;
    fs::remove(part.name, ignored);
    throw;
  }
  sync_folder_of(part.target);
}

void write_whole_text(const fs::path& path, std::string_view text) {
  if (is_device(path)) {
    const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.id() < 0)
      cannot_write(path, errno);
    if (!write_all(file.id(), std::as_bytes(std::span(text))))
      cannot_write(path, errno);
    return;
  }
  write_whole_file(path, [&](const fs::path& beside) {
    const Descriptor file(::open(beside.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.id() < 0)
      cannot_write(path, errno);
    if (!write_all(file.id(), std::as_bytes(std::span(text))))
      cannot_write(path, errno);
  });
}

void try_to_write(const fs::path& path) {
  const PartFile part = part_of(path);
  std::error_code ignored;
  fs::remove(part.name, ignored);
}

} // namespace strainwave
