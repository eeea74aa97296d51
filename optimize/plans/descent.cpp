#include "strainwave/optimize/plans/descent.hpp"

#include "strainwave/common/sampling/counter_random.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace strainwave {

namespace {

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

class Sampler {
public:
  Sampler(const Problem& problem, const SearchPoint& from,
          const std::function<SearchPoint(std::span<const double>)>& ask)
      : from_(from), ask_(ask), upper_(problem.design().scaled_upper()) {}

  /// Moves by shares of the ranges, inside the bounds.
  SearchPoint at(const Vector& centre, const Vector& share) {
    Vector y(centre.size());
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = std::clamp(centre[i] + share[i] * upper_[i], 0.0, upper_[i]);
    SearchPoint point = ask_(y);
    if (better(point, best_ ? *best_ : from_))
      best_ = point;
    return point;
  }

  /// The improvement function's largest piece: 0 the objective, k + 1 limit k.
  std::size_t piece(const SearchPoint& point) const {
    std::size_t largest = 0;
    double value = point.objective - from_.objective;
    for (std::size_t k = 0; k < point.constraint.size(); ++k) {
      if (point.constraint[k] > value) {
        value = point.constraint[k];
        largest = k + 1;
      }
    }
    return largest;
  }

  /// Slopes by shares of the ranges, towards the middle of the box.
  std::optional<Vector> slopes(const SearchPoint& at_point) {
    const std::size_t n = upper_.size(), k = piece(at_point);
    const auto value = [k](const SearchPoint& p) { return k == 0 ? p.objective : p.constraint[k - 1]; };
    Vector result(n);
    for (std::size_t i = 0; i < n; ++i) {
      Vector share(n, 0.0);
      share[i] = at_point.y[i] > 0.5 * upper_[i] ? -step : step;
      const SearchPoint next = at(at_point.y, share);
      if (!next.ok)
        return std::nullopt;
      result[i] = (value(next) - value(at_point)) / share[i];
      // A bound that is met takes away the slope that pushes against it.
      const bool pushes =
          at_point.y[i] <= 0.0 ? result[i] > 0.0 : at_point.y[i] >= upper_[i] && result[i] < 0.0;
      if (pushes)
        result[i] = 0.0;
    }
    return result;
  }

  const std::optional<SearchPoint>& best() const { return best_; }

private:
  static constexpr double step = 1e-6; ///< against slopes of 1 and rounding of 1e-12
  const SearchPoint& from_;
  const std::function<SearchPoint(std::span<const double>)>& ask_;
  Vector upper_;
  std::optional<SearchPoint> best_;
};

} // namespace

std::vector<double> shortest_in_hull(const std::vector<std::vector<double>>& vectors) {
  Vector v = vectors.front();
  for (int step = 0; step < 500; ++step) {
    const auto least =
        std::min_element(vectors.begin(), vectors.end(),
                         [&](const Vector& a, const Vector& b) { return dot(v, a) < dot(v, b); });
    Vector difference(v.size());
    for (std::size_t i = 0; i < v.size(); ++i)
      difference[i] = (*least)[i] - v[i];
    const double length2 = dot(difference, difference), gain = -dot(v, difference);
    if (gain <= 1e-10 * dot(v, v) || length2 == 0.0)
      break;
    const double t = std::min(1.0, gain / length2);
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] += t * difference[i];
  }
  return v;
}

std::optional<SearchPoint> find_descent(const Problem& problem, const SearchPoint& from, double radius,
                                        std::uint64_t seed,
                                        const std::function<SearchPoint(std::span<const double>)>& ask) {
  const std::size_t n = from.y.size();
  Sampler sampler(problem, from, ask);
  std::vector<Vector> slopes;
  for (std::size_t k = 0; k < n + 2; ++k) { // not at `from` itself: differences across a kink are no slopes
    Vector share(n);
    random_uniforms({seed, RandomPurpose::descent}, k, share);
    for (double& s : share)
      s = radius * (2.0 * s - 1.0);
    const SearchPoint sample = sampler.at(from.y, share);
    if (!sample.ok)
      continue;
    if (auto s = sampler.slopes(sample))
      slopes.push_back(std::move(*s));
  }
  if (slopes.empty())
    return sampler.best();
  Vector down = shortest_in_hull(slopes);
  const double length = std::sqrt(dot(down, down));
  if (length == 0.0)
    return sampler.best();
  for (const double t : {4.0, 1.0, 0.25}) {
    Vector share(n);
    for (std::size_t i = 0; i < n; ++i)
      share[i] = -t * radius * down[i] / length;
    (void)sampler.at(from.y, share);
  }
  return sampler.best();
}

} // namespace strainwave
