#include "strainwave/common/sampling/distribution.hpp"

#include "strainwave/common/sampling/normal_quantile.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace strainwave {

namespace {

template <class... F>
struct Cases : F... {
  using F::operator()...;
};
template <class... F>
Cases(F...) -> Cases<F...>;

void demand(bool holds, const std::string& sentence) {
  if (!holds)
    throw std::invalid_argument(sentence);
}

void demand_finite(std::initializer_list<double> numbers) {
  for (double x : numbers)
    demand(std::isfinite(x), "numbers of a distribution must be finite");
}

double log_spread(const Lognormal& d) {
  return std::sqrt(std::log1p(d.std * d.std / (d.mean * d.mean)));
}

double triangular_quantile(const Triangular& t, double u) {
  const double width = t.upper - t.lower;
  const double split = (t.mode - t.lower) / width;
  return u < split ? t.lower + std::sqrt(u * width * (t.mode - t.lower))
                   : t.upper - std::sqrt((1.0 - u) * width * (t.upper - t.mode));
}

double table_quantile(const Tabulated& t, double u) {
  const auto above = std::upper_bound(t.cumulative.begin() + 1, t.cumulative.end() - 1, u);
  const auto i = static_cast<std::size_t>(above - t.cumulative.begin());
  const double share = (u - t.cumulative[i - 1]) / (t.cumulative[i] - t.cumulative[i - 1]);
  return t.value[i - 1] + share * (t.value[i] - t.value[i - 1]);
}

} // namespace

void check_distribution(const Distribution& distribution) {
  const auto std_positive = [](double std) {
    demand(std > 0.0, fmt::format("the standard deviation must be above 0, is {}", std));
  };
  const auto ordered = [](double lower, double upper) {
    demand(lower < upper, fmt::format("lower must be below upper, are {} and {}", lower, upper));
  };
  std::visit(
      Cases{
          [&](const Normal& d) {
            demand_finite({d.mean, d.std});
            std_positive(d.std);
          },
          [&](const TruncatedNormal& d) {
            demand_finite({d.mean, d.std, d.lower, d.upper});
            std_positive(d.std);
            ordered(d.lower, d.upper);
            const double kept =
                normal_cdf((d.upper - d.mean) / d.std) - normal_cdf((d.lower - d.mean) / d.std);
            demand(kept > 1e-6, fmt::format("the limits {} and {} keep only {:.2g} of the distribution",
                                            d.lower, d.upper, kept));
          },
          [&](const Uniform& d) {
            demand_finite({d.lower, d.upper});
            ordered(d.lower, d.upper);
          },
          [&](const Triangular& d) {
            demand_finite({d.lower, d.mode, d.upper});
            ordered(d.lower, d.upper);
            demand(d.lower <= d.mode && d.mode <= d.upper,
                   fmt::format("the mode must lie between {} and {}, is {}", d.lower, d.upper, d.mode));
          },
          [&](const Lognormal& d) {
            demand_finite({d.mean, d.std});
            std_positive(d.std);
            demand(d.mean > 0.0, fmt::format("the mean of a lognormal value must be above 0, is {}", d.mean));
          },
          [&](const Tabulated& d) {
            demand(d.value.size() >= 2 && d.value.size() == d.cumulative.size(),
                   fmt::format("a table needs as many values as cumulative shares, at least 2; has {} and {}",
                               d.value.size(), d.cumulative.size()));
            for (std::size_t i = 0; i < d.value.size(); ++i) {
              demand_finite({d.value[i], d.cumulative[i]});
              demand(i == 0 || (d.value[i] >= d.value[i - 1] && d.cumulative[i] > d.cumulative[i - 1]),
                     fmt::format("values and cumulative shares of a table must ascend; row {} does not", i));
            }
            demand(d.cumulative.front() == 0.0 && d.cumulative.back() == 1.0,
                   "the cumulative shares of a table must run from 0 to 1");
          }},
      distribution);
}

Quantile::Quantile(const Distribution& distribution) : distribution_(distribution) {
  check_distribution(distribution);
  std::visit(Cases{[&](const Normal& d) {
                     normal_based_ = true;
                     a_ = d.mean;
                     b_ = d.std;
                   },
                   [&](const Lognormal& d) {
                     normal_based_ = true;
                     b_ = log_spread(d);
                     a_ = std::log(d.mean) - 0.5 * b_ * b_;
                   },
                   [&](const TruncatedNormal& d) {
                     a_ = normal_cdf((d.lower - d.mean) / d.std);
                     b_ = normal_cdf((d.upper - d.mean) / d.std) - a_;
                   },
                   [](const auto&) {}},
             distribution_);
}

double Quantile::operator()(double u) const {
  if (normal_based_)
    return of_normal(normal_quantile(u));
  return std::visit(Cases{[&](const TruncatedNormal& d) {
                            const double p = std::clamp(a_ + u * b_, 1e-300, 1.0 - 0x1p-53);
                            return std::clamp(d.mean + d.std * normal_quantile(p), d.lower, d.upper);
                          },
                          [&](const Uniform& d) { return d.lower + u * (d.upper - d.lower); },
                          [&](const Triangular& d) { return triangular_quantile(d, u); },
                          [&](const Tabulated& d) { return table_quantile(d, u); },
                          [&](const auto&) { return 0.0; }},
                    distribution_);
}

double Quantile::of_normal(double z) const {
  if (normal_based_) {
    const double value = a_ + b_ * z;
    return std::holds_alternative<Lognormal>(distribution_) ? std::exp(value) : value;
  }
  return (*this)(std::clamp(normal_cdf(z), 0x1p-1000, 1.0 - 0x1p-53));
}

} // namespace strainwave
