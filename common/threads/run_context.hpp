#pragma once
// What every run of the program is told, whatever it computes: handed down as one, from the command line to
// the finite elements.

#include <functional>
#include <string>

namespace strainwave {

struct RunContext {
  int threads = 0;                                   ///< 0: all that the process may use (usable_threads)
  bool disk_cache = true;                            ///< read and write the cache of solved cups
  std::function<bool()> stop = {};                   ///< asked often: end early? Empty: never
  std::function<void(const std::string&)> warn = {}; ///< sentences for people, from any thread
};

} // namespace strainwave
