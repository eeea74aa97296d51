#pragma once
// stdout carries results and nothing else; everything a person should know beside them goes to stderr as
// "strainwave: …", one line each.

#include <initializer_list>
#include <string>
#include <string_view>
#include <system_error>

namespace strainwave::app {

/// The reader of stdout is gone (strainwave … | head): no fault of anybody.
struct BrokenPipe : std::system_error {
  using std::system_error::system_error;
};

/// Throws BrokenPipe or std::system_error with the cause (disk full, stdout closed).
void print(std::string_view text);
void flush_output();

/// Throws UsageError when writing `output` would replace one of the input files (empty paths do not count).
void refuse_to_replace(const std::string& output, std::initializer_list<std::string> inputs);

/// Never throws: there is nobody left to tell.
void report(std::string_view message) noexcept;

} // namespace strainwave::app
