#include "strainwave/common/statistics/sobol_indices.hpp"

#include "strainwave/common/sampling/counter_random.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace strainwave {

namespace {

/// What the estimators sum, block by block: a + b, a² + b², then b (c_i − a) and (a − c_i)²/2 for each input.
struct Terms {
  std::size_t columns = 0; ///< 2 + 2 × inputs
  std::vector<double> rows;
  std::uint64_t blocks() const { return rows.size() / columns; }
};

Terms terms_of(std::span<const double> values, const std::vector<std::uint64_t>& good, std::size_t inputs) {
  const std::size_t rows = inputs + 2;
  double mean = 0.0;
  for (std::uint64_t block : good)
    mean += values[block * rows] + values[block * rows + 1];
  mean /= 2.0 * static_cast<double>(good.size());
  Terms terms{2 + 2 * inputs, {}};
  terms.rows.reserve(good.size() * terms.columns);
  for (std::uint64_t block : good) {
    const double* y = &values[block * rows];
    const double a = y[0] - mean, b = y[1] - mean;
    terms.rows.push_back(a + b);
    terms.rows.push_back(a * a + b * b);
    for (std::size_t i = 0; i < inputs; ++i) {
      const double c = y[2 + i] - mean;
      terms.rows.push_back(b * (c - a));
      terms.rows.push_back(0.5 * (a - c) * (a - c));
    }
  }
  return terms;
}

/// From sums over n blocks to [variance, first, total, first, total …].
void indices_from(std::span<const double> sums, double n, std::span<double> result) {
  const double mean = sums[0] / (2.0 * n);
  const double variance = (sums[1] - 2.0 * n * mean * mean) / (2.0 * n - 1.0);
  result[0] = variance;
  for (std::size_t j = 2; j < sums.size(); ++j)
    result[j - 1] = variance > 0.0 ? sums[j] / n / variance : 0.0;
}

void add_weighted(const Terms& terms, std::span<const std::uint32_t> weights, std::span<double> sums) {
  std::ranges::fill(sums, 0.0);
  for (std::uint64_t block = 0; block < terms.blocks(); ++block) {
    const double w = weights[block];
    if (weights[block] == 0)
      continue;
    const double* row = &terms.rows[block * terms.columns];
    for (std::size_t j = 0; j < terms.columns; ++j)
      sums[j] += w * row[j];
  }
}

/// How often each block is drawn in a resample of as many blocks.
void draw_weights(const BootstrapOptions& options, std::uint64_t resample, std::span<std::uint32_t> weights) {
  std::ranges::fill(weights, 0U);
  const std::uint64_t n = weights.size();
  const RandomKey key{options.seed, RandomPurpose::bootstrap};
  for (std::uint64_t i = 0; i < n; i += 4) {
    const auto words = random_block(key, resample, i / 4);
    for (std::size_t k = 0; k < 4 && i + k < n; ++k)
      ++weights[static_cast<std::uint64_t>(open_uniform(words[k]) * static_cast<double>(n))];
  }
}

std::vector<double> bootstrap_spread(const Terms& terms, const BootstrapOptions& options) {
  const std::size_t columns = terms.columns - 1;
  std::vector<std::uint32_t> weights(terms.blocks());
  std::vector<double> sums(terms.columns), result(columns), mean(columns, 0.0), square(columns, 0.0);
  for (int r = 0; r < options.resamples; ++r) {
    draw_weights(options, static_cast<std::uint64_t>(r), weights);
    add_weighted(terms, weights, sums);
    indices_from(sums, static_cast<double>(terms.blocks()), result);
    for (std::size_t j = 0; j < columns; ++j) { // running mean and sum of squares (Welford)
      const double d = result[j] - mean[j];
      mean[j] += d / (r + 1);
      square[j] += d * (result[j] - mean[j]);
    }
  }
  for (double& s : square)
    s = std::sqrt(s / (options.resamples - 1));
  return square;
}

} // namespace

SobolIndices sobol_indices(std::span<const double> values, std::span<const std::uint8_t> status,
                           std::size_t inputs, const BootstrapOptions& options) {
  const std::size_t rows = inputs + 2;
  if (values.size() != status.size() || values.size() % rows != 0)
    throw std::logic_error("sobol_indices: rows are no whole blocks");
  const std::uint64_t blocks = values.size() / rows;
  std::vector<std::uint64_t> good;
  for (std::uint64_t block = 0; block < blocks; ++block)
    if (std::ranges::all_of(status.subspan(block * rows, rows), [](std::uint8_t s) { return s == 0; }))
      good.push_back(block);
  if (good.size() < 8)
    throw std::invalid_argument(fmt::format(
        "only {} of {} blocks have no failed row: too few for Sobol' indices", good.size(), blocks));

  const Terms terms = terms_of(values, good, inputs);
  std::vector<double> sums(terms.columns), result(terms.columns - 1);
  const std::vector<std::uint32_t> once(good.size(), 1U);
  add_weighted(terms, once, sums);
  indices_from(sums, static_cast<double>(good.size()), result);
  const std::vector<double> spread = bootstrap_spread(terms, options);

  SobolIndices indices{good.size(), blocks - good.size(), result[0], {}};
  for (std::size_t i = 0; i < inputs; ++i) {
    const std::size_t f = 1 + 2 * i, t = 2 + 2 * i;
    const double half = normal_975 * spread[f];
    const double factor = result[t] > 0.0 ? std::exp(normal_975 * spread[t] / result[t]) : 1.0;
    indices.inputs.push_back({{result[f], {result[f] - half, result[f] + half}},
                              {result[t], {result[t] / factor, result[t] * factor}}});
  }
  return indices;
}

std::vector<SobolIndices> nested_sobol_indices(std::span<const double> values,
                                               std::span<const std::uint8_t> status, std::size_t inputs,
                                               std::uint64_t least, const BootstrapOptions& options) {
  const std::size_t rows = inputs + 2;
  std::vector<SobolIndices> nested;
  for (std::uint64_t blocks = values.size() / rows; blocks >= std::max<std::uint64_t>(least, 8);
       blocks /= 2) {
    nested.push_back(
        sobol_indices(values.first(blocks * rows), status.first(blocks * rows), inputs, options));
    if (blocks % 2 != 0)
      break;
  }
  std::ranges::reverse(nested);
  return nested;
}

} // namespace strainwave
