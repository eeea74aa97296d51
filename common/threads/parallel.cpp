#include "strainwave/common/threads/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace strainwave {

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  const unsigned wanted =
      threads > 0 ? static_cast<unsigned>(threads) : std::max(1u, std::thread::hardware_concurrency());
  const std::size_t workers = std::min<std::size_t>(wanted, count);
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
