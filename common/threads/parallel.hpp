#pragma once
// The same work for k = 0 … count − 1 on several threads, each taking the next index that is left. Results
// belong into places by index. The first exception, by index, is thrown on when all threads have come to
// rest; no index is begun after one has thrown.

#include <functional>

namespace strainwave {

/// threads = 0: as many as the machine offers.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

} // namespace strainwave
