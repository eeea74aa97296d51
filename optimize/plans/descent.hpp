#pragma once
// Is there a way down from here? A test of local optimality that holds at kinks, where a largest meshing
// force has its minima, and where simplices and gradients get stuck: gradient sampling (J. Burke, A. Lewis,
// M. Overton, SIAM J. Optim. 15, 2005) on the improvement function
//
//     F(y) = max( f(y) − f(y₀), g₁(y), …, g_m(y) ),
//
// of which a constrained minimum y₀ is a free one. Slopes of F are taken at points spread over a small ball;
// minus the shortest vector in their convex hull is a direction in which all the pieces fall that meet near
// y₀. If it is (nearly) zero, or leads nowhere, there is no way down of first order.

#include "strainwave/optimize/problem/problem.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace strainwave {

/// The best point better than `from` that was met while looking within `radius` (share of the coordinates'
/// ranges), if any. Asks for about (n + 2)(n + 1) points.
std::optional<SearchPoint> find_descent(const Problem& problem, const SearchPoint& from, double radius,
                                        std::uint64_t seed,
                                        const std::function<SearchPoint(std::span<const double>)>& ask);

/// The shortest vector in the convex hull of `vectors` (Frank and Wolfe with exact steps).
std::vector<double> shortest_in_hull(const std::vector<std::vector<double>>& vectors);

} // namespace strainwave
