#include "app/stop_request.hpp"

#include <atomic>
#include <csignal>

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
