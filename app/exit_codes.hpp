#pragma once
// How the program ends, and which exception means which end. Scripts and batch systems rely on these numbers:
//   0 done · 2 wrong use or wrong file (never retry) · 3 well-formed, but the gear has no result or the
//   result is not good · 70 our bug · 74 disk, memory or permissions (fix and run again) · 75 stopped early
//   (run again to resume)

#include <functional>
#include <stdexcept>
#include <string>

namespace strainwave::app {

enum class ExitCode {
  done = 0,
  wrong_input = 2,
  no_result = 3,
  our_bug = 70,
  environment = 74,
  stopped = 75
};

/// The command line cannot mean anything: the sentence says what was expected.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs a command, writes what it printed, and turns every exception into one sentence on stderr and an exit
/// code:
///   UsageError, FileError, FieldError → 2;  std::bad_alloc, std::system_error (files, stdout) → 74;
///   BrokenPipe → 0, silently;  everything else → 70.
ExitCode run_guarded(const std::function<ExitCode()>& command) noexcept;

/// A closed pipe is reported by write() instead of ending the program, and an exception that nobody catches
/// ends with 70.
void install_process_habits();

} // namespace strainwave::app
