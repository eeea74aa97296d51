#pragma once
// Memory is asked for before it is used: a mesh that cannot fit ends with a sentence at once, not with a
// machine that swaps or a process that is shot.

#include <new>
#include <string>

namespace strainwave {

/// Not enough memory, with the sentence that says for what.
class OutOfMemory : public std::bad_alloc {
public:
  explicit OutOfMemory(std::string sentence) : sentence_(std::move(sentence)) {}
  const char* what() const noexcept override { return sentence_.c_str(); }

private:
  std::string sentence_;
};

/// What this process may still take, bytes: the least of the machine's available memory, the limit of its
/// control group and of the process (ulimit -v). Infinity where the system does not say.
double available_memory_bytes();

/// Throws OutOfMemory "… needs about 12.3 GB of memory, 4.5 GB are available; …" when `bytes` do not fit.
/// what: "the finite elements of 140 sectors with 12345 elements each"; advice: what makes it smaller.
void require_memory(double bytes, const std::string& what, const std::string& advice);

} // namespace strainwave
