#include "studies/engine/stop_request.hpp"

namespace strainwave {

namespace {

constexpr int caught[3] = {SIGINT, SIGTERM, SIGUSR1};
StopRequest by_signal;

void note_signal(int number) {
  by_signal.ask(number);
}

} // namespace

StopSignals::StopSignals() {
  by_signal.ask(0);
  struct sigaction action = {};
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (int i = 0; i < 3; ++i)
    sigaction(caught[i], &action, &before_[i]);
}

StopSignals::~StopSignals() {
  for (int i = 0; i < 3; ++i)
    sigaction(caught[i], &before_[i], nullptr);
}

const StopRequest& StopSignals::request() const {
  return by_signal;
}

} // namespace strainwave
