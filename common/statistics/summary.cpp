#include "strainwave/common/statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace strainwave {

namespace {

struct Moments {
  double mean = 0.0, variance = 0.0, fourth = 0.0; ///< variance with n − 1; fourth central moment with n
};

Moments moments_of(std::span<const double> x) {
  const double n = static_cast<double>(x.size());
  Moments m;
  for (double v : x)
    m.mean += v;
  m.mean /= n;
  double rest = 0.0; // second pass: what rounding left in the mean
  for (double v : x)
    rest += v - m.mean;
  m.mean += rest / n;
  double square = 0.0;
  for (double v : x) {
    const double d2 = (v - m.mean) * (v - m.mean);
    square += d2;
    m.fourth += d2 * d2;
  }
  m.variance = square / (n - 1.0);
  m.fourth /= n;
  return m;
}

std::vector<double> sorted_copy(std::span<const double> x) {
  std::vector<double> sorted(x.begin(), x.end());
  std::ranges::sort(sorted);
  return sorted;
}

std::uint64_t count_above(std::span<const double> sorted, double limit) {
  return static_cast<std::uint64_t>(sorted.end() - std::ranges::upper_bound(sorted, limit));
}

/// Bin width of Freedman and Diaconis (1981): 2 (interquartile range) n^(−1/3); at most 200 bins.
Histogram histogram_of(std::span<const double> sorted, int bins) {
  Histogram h{sorted.front(), sorted.back(), {}};
  const double range = h.upper - h.lower;
  if (bins <= 0) {
    const double quartiles = sorted_quantile(sorted, 0.75) - sorted_quantile(sorted, 0.25);
    const double width = 2.0 * quartiles / std::cbrt(static_cast<double>(sorted.size()));
    bins = width > 0.0 ? static_cast<int>(std::clamp(std::ceil(range / width), 1.0, 200.0)) : 1;
  }
  h.counts.assign(static_cast<std::size_t>(bins), 0);
  for (double x : sorted) {
    const int bin = range > 0.0 ? static_cast<int>((x - h.lower) / range * bins) : 0;
    ++h.counts[static_cast<std::size_t>(std::min(bin, bins - 1))];
  }
  return h;
}

/// Variance of s² is (m4 − s⁴ (n − 3)/(n − 1))/n; on the logarithm of s the interval stays positive.
Estimate std_estimate(const Moments& m, double n) {
  const double s = std::sqrt(m.variance);
  if (!(m.variance > 0.0))
    return {0.0, {0.0, 0.0}};
  const double of_square = std::max(m.fourth / (m.variance * m.variance) - (n - 3.0) / (n - 1.0), 0.0) / n;
  const double half = student_975(n - 1.0) * 0.5 * std::sqrt(of_square);
  return {s, {s * std::exp(-half), s * std::exp(half)}};
}

Summary without_intervals(std::span<const double> values, std::span<const double> sorted,
                          const SummaryRequest& request) {
  const Moments m = moments_of(values);
  Summary s;
  s.samples = values.size();
  s.mean.value = m.mean;
  s.std.value = std::sqrt(m.variance);
  s.least = sorted.front();
  s.greatest = sorted.back();
  for (double p : request.quantiles)
    s.quantiles.push_back({p, {sorted_quantile(sorted, p), {}}});
  for (double limit : request.limits)
    s.exceedances.push_back(
        {limit, {static_cast<double>(count_above(sorted, limit)) / static_cast<double>(sorted.size()), {}}});
  return s;
}

void demand_size(std::size_t n) {
  if (n < 4)
    throw std::invalid_argument("statistics need at least 4 samples with a result");
}

} // namespace

double sorted_quantile(std::span<const double> sorted, double probability) {
  const double at = probability * static_cast<double>(sorted.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), sorted.size() - 1);
  const double next = sorted[std::min(i + 1, sorted.size() - 1)];
  return sorted[i] + (at - static_cast<double>(i)) * (next - sorted[i]);
}

Summary summarise(std::span<const double> values, const SummaryRequest& request) {
  demand_size(values.size());
  const std::vector<double> sorted = sorted_copy(values);
  const Moments m = moments_of(values);
  const double n = static_cast<double>(values.size());
  Summary s = without_intervals(values, sorted, request);
  const double half = student_975(n - 1.0) * std::sqrt(m.variance / n);
  s.mean.ci95 = {m.mean - half, m.mean + half};
  s.std = std_estimate(m, n);
  for (QuantileEstimate& q : s.quantiles) {
    const QuantileRanks ranks = quantile_ranks(q.probability, values.size());
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    q.estimate.ci95 = {ranks.lower < 1 ? -unbounded : sorted[ranks.lower - 1],
                       ranks.upper > sorted.size() ? unbounded : sorted[ranks.upper - 1]};
  }
  for (ExceedanceEstimate& e : s.exceedances)
    e.probability.ci95 = wilson_interval(count_above(sorted, e.limit), values.size());
  s.histogram = histogram_of(sorted, request.bins);
  return s;
}

Summary summarise_randomised(std::span<const std::span<const double>> parts, const SummaryRequest& request) {
  std::vector<double> all;
  std::vector<Summary> each;
  for (const auto& part : parts) {
    demand_size(part.size());
    all.insert(all.end(), part.begin(), part.end());
    each.push_back(without_intervals(part, sorted_copy(part), request));
  }
  const std::vector<double> sorted = sorted_copy(all);
  Summary s = without_intervals(all, sorted, request);
  std::vector<double> replicates(each.size());
  const auto bound = [&](Estimate& estimate, auto&& of) {
    std::ranges::transform(each, replicates.begin(), of);
    estimate = from_replicates(estimate.value, replicates);
  };
  bound(s.mean, [](const Summary& e) { return e.mean.value; });
  bound(s.std, [](const Summary& e) { return e.std.value; });
  for (std::size_t i = 0; i < s.quantiles.size(); ++i)
    bound(s.quantiles[i].estimate, [i](const Summary& e) { return e.quantiles[i].estimate.value; });
  for (std::size_t i = 0; i < s.exceedances.size(); ++i) {
    Estimate& p = s.exceedances[i].probability;
    bound(p, [i](const Summary& e) { return e.exceedances[i].probability.value; });
    p.ci95 = {std::max(p.ci95.lower, 0.0), std::min(p.ci95.upper, 1.0)};
  }
  s.histogram = histogram_of(sorted, request.bins);
  return s;
}

} // namespace strainwave
