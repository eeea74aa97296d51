// The hot loop does not allocate: every operator new of this program is counted.

#include "strainwave/model/lcp/path.hpp"
#include "tests/model/lcp/problems.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size ? size : 1))
    return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

namespace strainwave {
namespace {

TEST(LcpAllocation, SolvesAndPathsReuseTheirBuffers) {
  const ContactProblem problem = contact_problems::smooth(140);
  ContactSolver solver;
  ContactState state;
  EventPath path;
  const ContactOptions options;
  const ActiveSet cold;
  const auto round = [&] {
    for (const double rotation : {1e-3, 2e-3, 4e-3, 8e-3}) {
      solver.solve_at(problem, rotation, cold, options, state);
      const ActiveSet& warm = state.active;
      solver.solve_at(problem, rotation * 1.01, warm, options, state);
    }
    solver.trace(problem, {.end_rotation = 8e-3}, options, path);
  };
  round();
  const long before = allocations;
  round();
  // The tracer keeps five small work arrays of its own; the solves none.
  EXPECT_LE(allocations - before, 16);
  const long solves_before = allocations;
  solver.solve_at(problem, 4e-3, cold, options, state);
  EXPECT_EQ(allocations - solves_before, 0);
}

} // namespace
} // namespace strainwave
