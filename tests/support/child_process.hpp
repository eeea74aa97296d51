#pragma once
// A part of a test in a process of its own: what it does to limits, umask or the disk ends with it.

#include <csignal>
#include <functional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace strainwave::testing_support {

/// Starts `work` in a child; its number ends as the child's exit code, an exception as 99.
inline pid_t start_child(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child != 0)
    return child;
  int code = 99;
  try {
    code = work();
  } catch (...) { // the code says so
  }
  ::_exit(code);
}

inline int end_of_child(pid_t child) {
  int status = -1;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Files of this process end at `bytes`, as on a disk that is full: with an error.
inline void limit_file_size(rlim_t bytes) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

} // namespace strainwave::testing_support
