#include "strainwave/common/core/memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>

namespace strainwave {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The first number behind `key` in a file of lines "Key:  number kB"; an empty key: the file is the number.
double number_in(const char* path, const std::string& key) {
  std::ifstream file(path);
  for (std::string word; file >> word;) {
    if (key.empty())
      file.seekg(0);
    else if (word != key)
      continue;
    double value = 0.0;
    return file >> value ? value : unlimited; // "max" is no number
  }
  return unlimited;
}

double gigabytes(double bytes) {
  return bytes / 1e9;
}

} // namespace

double available_memory_bytes() {
  const double machine = 1024.0 * number_in("/proc/meminfo", "MemAvailable:");
  const double group = number_in("/sys/fs/cgroup/memory.max", "");
  const double group_used = number_in("/sys/fs/cgroup/memory.current", "");
  double least =
      std::min(machine, group < unlimited && group_used < unlimited ? group - group_used : unlimited);
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    const double pages = number_in("/proc/self/statm", "");
    least = std::min(least, static_cast<double>(limit.rlim_cur) - (pages < unlimited ? 4096.0 * pages : 0.0));
  }
  return std::max(0.0, least);
}

void require_memory(double bytes, const std::string& what, const std::string& advice) {
  const double available = available_memory_bytes();
  if (!(bytes > available))
    return;
  char sizes[100];
  std::snprintf(sizes, sizeof sizes, " need about %.3g GB of memory, %.3g GB are available; ",
                gigabytes(bytes), gigabytes(available));
  throw OutOfMemory(what + sizes + advice);
}

} // namespace strainwave
