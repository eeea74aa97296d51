#include "app/output.hpp"

#include <cerrno>
#include <cstdio>

namespace strainwave::app {

namespace {

[[noreturn]] void fail(int error) {
  if (error == EPIPE)
    throw BrokenPipe(error, std::generic_category());
  throw std::system_error(error ? error : EIO, std::generic_category(), "cannot write to standard output");
}

} // namespace

void print(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size())
    fail(errno);
}

void flush_output() {
  errno = 0;
  if (std::fflush(stdout) != 0)
    fail(errno);
}

void report(std::string_view message) noexcept {
  while (!message.empty()) {
    const std::size_t end = message.find('\n');
    const std::string_view line = message.substr(0, end);
    std::fprintf(stderr, "strainwave: %.*s\n", static_cast<int>(line.size()), line.data());
    message.remove_prefix(end == std::string_view::npos ? message.size() : end + 1);
  }
}

} // namespace strainwave::app
