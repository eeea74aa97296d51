#include "strainwave/common/files/whole_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <system_error>
#include <unistd.h>

namespace strainwave {

namespace {

class Descriptor {
public:
  Descriptor(const std::filesystem::path& path, int flags)
      : id_(::open(path.c_str(), flags | O_CLOEXEC, 0666)), path_(path.string()) {
    if (id_ < 0)
      fail("cannot write ");
  }
  ~Descriptor() { ::close(id_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void sync() const {
    if (::fsync(id_) != 0)
      fail("cannot sync ");
  }
  void write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t done = ::write(id_, text.data(), text.size());
      if (done < 0 && errno == EINTR)
        continue;
      if (done <= 0)
        fail("cannot write ");
      text.remove_prefix(static_cast<std::size_t>(done));
    }
  }

private:
  [[noreturn]] void fail(const char* what) const {
    throw std::system_error(errno, std::generic_category(), what + path_);
  }
  int id_;
  std::string path_;
};

} // namespace

void sync_folder_of(const std::filesystem::path& path) {
  const auto folder = path.parent_path();
  Descriptor(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY).sync();
}

void write_whole_file(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path beside = path.string() + ".part" + std::to_string(::getpid());
  try {
    write(beside);
    Descriptor(beside, O_RDWR).sync();
    std::filesystem::rename(beside, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw;
  }
  sync_folder_of(path);
}

void write_whole_text(const std::filesystem::path& path, std::string_view text) {
  write_whole_file(path, [&](const std::filesystem::path& beside) {
    Descriptor(beside, O_WRONLY | O_CREAT | O_TRUNC).write(text);
  });
}

} // namespace strainwave
