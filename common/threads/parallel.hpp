#pragma once
// The same work for k = 0 … count − 1 on several threads, each taking the next index that is left. Results
// belong into places by index. The first exception, by index, is thrown on when all threads have come to
// rest; no index is begun after one has thrown.

#include <cstddef>
#include <functional>

namespace strainwave {

/// As many threads as are asked for; 0: as many as CPUs that this process may use (taskset, cgroups' cpusets,
/// a batch system's share), which may be fewer than the machine has.
int usable_threads(int wanted = 0);

/// On usable_threads(threads).
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

} // namespace strainwave
