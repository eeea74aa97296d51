#pragma once
// Asking a run to end early: by a signal, or from the program.

#include <atomic>
#include <csignal>

namespace strainwave {

/// A flag that a signal handler may set.
class StopRequest {
public:
  void ask(int reason) noexcept { reason_.store(reason, std::memory_order_relaxed); }
  /// 0: nobody asked; otherwise the signal's number.
  int reason() const noexcept { return reason_.load(std::memory_order_relaxed); }

private:
  std::atomic<int> reason_{0};
  static_assert(std::atomic<int>::is_always_lock_free);
};

/// While it lives, SIGINT, SIGTERM and SIGUSR1 (Slurm's warning before the time limit) set its request
/// instead of ending the program. One at a time.
class StopSignals {
public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  const StopRequest& request() const;

private:
  struct sigaction before_[3];
};

} // namespace strainwave
