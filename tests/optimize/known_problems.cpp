// Problems from W. Hock and K. Schittkowski, Test Examples for Nonlinear Programming Codes (1981), with the
// answers printed there, and classical others.

#include "tests/optimize/function_evaluator.hpp"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

using X = std::span<const double>;
double rosenbrock(X x) {
  return 100.0 * square(x[1] - x[0] * x[0]) + square(1.0 - x[0]);
}

} // namespace

std::vector<KnownProblem> known_problems() {
  return {
      {.name = "Rosenbrock's valley",
       .box = {{-2, 2, -1.2}, {-2, 2, 1}},
       .function = [](X x) { return std::vector{rosenbrock(x)}; },
       .limits = 0,
       .least = 0.0,
       .narrow_valley = true},
      // The minimum of (1 − x)² + 100 (y − x²)² in the disc of radius √2 is its own, (1, 1), on the edge of
      // the disc.
      {.name = "Rosenbrock's valley in a disc",
       .box = {{-1.5, 1.5, -0.5}, {-1.5, 1.5, 0.5}},
       .function =
           [](X x) {
             return std::vector{rosenbrock(x), x[0] * x[0] + x[1] * x[1] - 2.0};
           },
       .limits = 1,
       .least = 0.0,
       .narrow_valley = true},
      {.name = "HS 24: linear limits, a vertex",
       .box = {{0, 5, 1}, {0, 5, 0.5}},
       .function =
           [](X x) {
             const double r3 = std::sqrt(3.0);
             return std::vector{(square(x[0] - 3.0) - 9.0) * x[1] * x[1] * x[1] / (27.0 * r3),
                                x[1] - x[0] / r3, -(x[0] + r3 * x[1]), x[0] + r3 * x[1] - 6.0};
           },
       .limits = 3,
       .least = -1.0},
      {.name = "HS 35: quadratic, one linear limit",
       .box = {{0, 3, 0.5}, {0, 3, 0.5}, {0, 3, 0.5}},
       .function =
           [](X x) {
             return std::vector{9.0 - 8.0 * x[0] - 6.0 * x[1] - 4.0 * x[2] + 2.0 * x[0] * x[0] +
                                    2.0 * x[1] * x[1] + x[2] * x[2] + 2.0 * x[0] * x[1] + 2.0 * x[0] * x[2],
                                x[0] + x[1] + 2.0 * x[2] - 3.0};
           },
       .limits = 1,
       .least = 1.0 / 9.0},
      {.name = "HS 43 (Rosen and Suzuki)",
       .box = {{-4, 4, 0}, {-4, 4, 0}, {-4, 4, 0}, {-4, 4, 0}},
       .function =
           [](X x) {
             const double a = x[0] * x[0], b = x[1] * x[1], c = x[2] * x[2], d = x[3] * x[3];
             return std::vector{a + b + 2.0 * c + d - 5.0 * x[0] - 5.0 * x[1] - 21.0 * x[2] + 7.0 * x[3],
                                a + b + c + d + x[0] - x[1] + x[2] - x[3] - 8.0,
                                a + 2.0 * b + c + 2.0 * d - x[0] - x[3] - 10.0,
                                2.0 * a + b + c + 2.0 * x[0] - x[1] - x[3] - 5.0};
           },
       .limits = 3,
       .least = -44.0},
      // Charalambous and Bandler: max(x1⁴ + x2², (2 − x1)² + (2 − x2)², 2 exp(x2 − x1)) has its least value 2
      // at (1, 1).
      {.name = "minimax of Charalambous and Bandler",
       .box = {{-3, 3, 2}, {-3, 3, 2}},
       .function =
           [](X x) {
             return std::vector{
                 std::max({square(x[0] * x[0]) + x[1] * x[1], square(2.0 - x[0]) + square(2.0 - x[1]),
                           2.0 * std::exp(x[1] - x[0])})};
           },
       .limits = 0,
       .least = 2.0,
       .smooth = false},
  };
}

std::vector<KnownProblem> known_global_problems() {
  return {
      // L. C. W. Dixon and G. P. Szegő (1978): six minima.
      {.name = "six-hump camel",
       .box = {{-3, 3, 1.6}, {-2, 2, -0.6}},
       .function =
           [](X x) {
             const double a = x[0] * x[0], b = x[1] * x[1];
             return std::vector{(4.0 - 2.1 * a + a * a / 3.0) * a + x[0] * x[1] + (4.0 * b - 4.0) * b};
           },
       .limits = 0,
       .least = -1.0316284535},
      // S. K. Mishra (2006), in the disc (x + 5)² + (y + 5)² ≤ 25.
      {.name = "Mishra's bird in a disc",
       .box = {{-10, 0, -8}, {-6.5, 0, -4}},
       .function =
           [](X x) {
             const double s = std::sin(x[1]), c = std::cos(x[0]);
             return std::vector{s * std::exp(square(1.0 - c)) + c * std::exp(square(1.0 - s)) +
                                    square(x[0] - x[1]),
                                square(x[0] + 5.0) + square(x[1] + 5.0) - 25.0};
           },
       .limits = 1,
       .least = -106.7645367},
  };
}

} // namespace strainwave
