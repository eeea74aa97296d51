#include "strainwave/common/threads/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <sched.h>
#include <thread>
#include <vector>

namespace strainwave {

int usable_threads(int wanted) {
  if (wanted > 0)
    return wanted;
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    return std::max(CPU_COUNT(&set), 1);
  return static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  const std::size_t workers = std::min(static_cast<std::size_t>(usable_threads(threads)), count);
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> broken = false;
  std::vector<std::exception_ptr> thrown(count);
  const auto worker = [&] {
    for (std::size_t k = next++; k < count && !broken; k = next++) {
      try {
        work(k);
      } catch (...) {
        thrown[k] = std::current_exception();
        broken = true;
      }
    }
  };
  {
    std::vector<std::jthread> pool;
    for (std::size_t i = 1; i < workers; ++i)
      pool.emplace_back(worker);
    worker();
  }
  for (const auto& exception : thrown) {
    if (exception)
      std::rethrow_exception(exception);
  }
}

} // namespace strainwave
