#include "strainwave/common/sampling/counter_random.hpp"
#include "strainwave/common/sampling/permutation.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

namespace strainwave {
namespace {

// Known answers of philox4x64-10 (kat_vectors of Random123 1.14): zero key and counter.
TEST(CounterRandom, IsThePublishedPhilox) {
  const auto words = random_block({0, RandomPurpose{0}}, 0, 0, 0);
  EXPECT_EQ(words[0], 0x16554d9eca36314cULL);
  EXPECT_EQ(words[1], 0xdb20fe9d672d0fdcULL);
  EXPECT_EQ(words[2], 0xd7e772cee186176bULL);
  EXPECT_EQ(words[3], 0x7e68b68aec7ba23bULL);
}

TEST(CounterRandom, NumbersOfOneSampleDoNotDependOnHowManyAreAskedFor) {
  const RandomKey key{7, RandomPurpose::samples};
  std::vector<double> few(3), many(9);
  random_uniforms(key, 41, few);
  random_uniforms(key, 41, many);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  EXPECT_EQ(many[6], open_uniform(random_bits(key, 41, 6)));
}

TEST(CounterRandom, UniformNumbersNeverReachTheEnds) {
  EXPECT_GT(open_uniform(0), 0.0);
  EXPECT_LT(open_uniform(~0ULL), 1.0);
}

TEST(CounterRandom, SeedPurposeAndLaneSeparateNumbers) {
  const auto a = random_bits({1, RandomPurpose::samples}, 5, 0);
  EXPECT_NE(a, random_bits({2, RandomPurpose::samples}, 5, 0));
  EXPECT_NE(a, random_bits({1, RandomPurpose::bootstrap}, 5, 0));
  EXPECT_NE(a, random_bits({1, RandomPurpose::samples}, 5, 0, 1));
}

TEST(Permutation, VisitsEveryPlaceOnce) {
  for (std::uint64_t n : {1, 2, 3, 5, 16, 17, 100, 1000, 4097}) {
    const Permutation order(n, random_block({3, RandomPurpose::hypercube_order}, n, 0));
    std::vector<std::uint64_t> seen(n), all(n);
    for (std::uint64_t i = 0; i < n; ++i)
      seen[i] = order(i);
    std::sort(seen.begin(), seen.end());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(seen, all) << n;
  }
}

// Every cell of (place, value) is hit with probability 1/n: chi-square over 8 × 8 cells and 8000 permutations
// has 49 degrees of freedom; 100 is past its 0.99997 quantile.
TEST(Permutation, SendsEveryPlaceEverywhereAlike) {
  constexpr int n = 8, trials = 8000;
  double hits[n][n] = {};
  for (int t = 0; t < trials; ++t) {
    const Permutation order(
        n, random_block({9, RandomPurpose::hypercube_order}, static_cast<std::uint64_t>(t), 0));
    for (std::uint64_t i = 0; i < n; ++i)
      hits[i][order(i)] += 1.0;
  }
  double chi_square = 0.0;
  for (auto& row : hits)
    for (double h : row)
      chi_square += (h - trials / 8.0) * (h - trials / 8.0) / (trials / 8.0);
  EXPECT_LT(chi_square, 100.0);
}

} // namespace
} // namespace strainwave
