#pragma once
// The wish to end early: SIGINT, SIGTERM, SIGUSR1 (what batch systems send before they kill), or a time
// limit. A command that can be continued asks now and then, brings its files in order and ends with
// ExitCode::stopped.

#include <chrono>
#include <functional>
#include <optional>
#include <thread>

namespace strainwave::app {

/// From here on the signals set a flag instead of ending the program; a second one ends it at once.
void catch_stop_signals();

/// Has one of the signals come?
bool stop_signalled();

/// Ends the program with ExitCode::stopped, whatever is in flight.
[[noreturn]] void leave_stopped();

/// Leaves the program with ExitCode::stopped 4.8 s after a stop was asked for, whatever it is doing then:
/// batch systems kill soon after. Nothing that counts is lost: journals are synced every second, other files
/// are renamed into place.
class StopGuard {
public:
  explicit StopGuard(std::function<bool()> stop);

private:
  std::jthread watch_;
};

class StopRequest {
public:
  /// Seconds from now; nothing: no limit.
  explicit StopRequest(std::optional<double> time_limit_s);
  bool operator()() const;
  /// Until the limit.
  std::optional<double> seconds_left() const;

private:
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

} // namespace strainwave::app
