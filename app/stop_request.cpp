#include "app/stop_request.hpp"

#include "app/exit_codes.hpp"
#include "app/output.hpp"

#include <atomic>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <mutex>

namespace strainwave::app {

namespace {

std::atomic<bool> signalled = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

void on_signal(int number) {
  signalled = true;
  std::signal(number, SIG_DFL);
}

} // namespace

void catch_stop_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGUSR1})
    std::signal(number, on_signal);
}

bool stop_signalled() {
  return signalled;
}

void leave_stopped() {
  report("stopped early with work in flight, which is dropped; run again to go on");
  std::_Exit(static_cast<int>(ExitCode::stopped));
}

StopGuard::StopGuard(std::function<bool()> stop)
    : watch_([asked = std::move(stop)](const std::stop_token& done) {
        using namespace std::chrono_literals;
        std::optional<std::chrono::steady_clock::time_point> leave;
        std::mutex mutex;
        std::condition_variable_any wake;
        std::unique_lock lock(mutex);
        while (!done.stop_requested()) {
          wake.wait_for(lock, done, 50ms, [] { return false; });
          const auto now = std::chrono::steady_clock::now();
          if (!leave && asked())
            leave = now + 4800ms;
          if (leave && now >= *leave && !done.stop_requested()) {
            report("stopped early with work in flight, which is dropped; run again to go on");
            std::_Exit(static_cast<int>(ExitCode::stopped));
          }
        }
      }) {}

StopRequest::StopRequest(std::optional<double> time_limit_s) {
  if (time_limit_s)
    deadline_ =
        std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                               std::chrono::duration<double>(*time_limit_s));
}

bool StopRequest::operator()() const {
  return signalled || (deadline_ && std::chrono::steady_clock::now() >= *deadline_);
}

std::optional<double> StopRequest::seconds_left() const {
  if (!deadline_)
    return std::nullopt;
  return std::chrono::duration<double>(*deadline_ - std::chrono::steady_clock::now()).count();
}

} // namespace strainwave::app
