#include "app/output.hpp"

#include "app/exit_codes.hpp"

#include <cerrno>
#include <cstdio>

#include <filesystem>

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

void refuse_to_replace(const std::string& output, std::initializer_list<std::string> inputs) {
  if (output.empty())
    return;
  for (const std::string& input : inputs) {
    std::error_code none; // a file that does not exist is nobody's input
    if (!input.empty() && std::filesystem::equivalent(output, input, none))
      throw UsageError(
          output + " is an input of this command and would be replaced; give another name for the output");
  }
}

} // namespace strainwave::app
