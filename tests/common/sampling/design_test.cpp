#include "strainwave/common/sampling/design.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <string>

namespace strainwave {
namespace {

std::vector<double> all_points(const SampleDesign& design) {
  std::vector<double> u(design.plan().samples * static_cast<std::size_t>(design.plan().dimensions));
  design.points(0, design.plan().samples, u);
  return u;
}

class EveryDesign : public testing::TestWithParam<SamplingDesign> {};

TEST_P(EveryDesign, GivesTheSameBitsHoweverItIsCut) {
  const SampleDesign design(
      {.design = GetParam(), .seed = 11, .samples = 256, .dimensions = 7, .randomisations = 4});
  const auto whole = all_points(design);
  for (std::uint64_t first = 0; first < 256;) {
    const std::size_t count = std::min<std::size_t>(1 + first % 13, 256 - first);
    std::vector<double> piece(count * 7);
    design.points(first, count, piece);
    for (std::size_t i = 0; i < piece.size(); ++i)
      ASSERT_EQ(piece[i], whole[first * 7 + i]);
    first += count;
  }
}

TEST_P(EveryDesign, AnotherSeedIsAnotherDesign) {
  DesignPlan plan{.design = GetParam(), .seed = 1, .samples = 64, .dimensions = 3, .randomisations = 2};
  const auto one = all_points(SampleDesign(plan));
  plan.seed = 2;
  EXPECT_NE(one, all_points(SampleDesign(plan)));
}

INSTANTIATE_TEST_SUITE_P(Designs, EveryDesign,
                         testing::Values(SamplingDesign::random, SamplingDesign::latin_hypercube,
                                         SamplingDesign::sobol));

class Stratified : public testing::TestWithParam<SamplingDesign> {};

// A net in base 2 is a Latin hypercube as well: each of the n intervals is visited once by every coordinate.
TEST_P(Stratified, EveryIntervalIsVisitedOnceInEveryRandomisation) {
  const SampleDesign design(
      {.design = GetParam(), .seed = 5, .samples = 512, .dimensions = 40, .randomisations = 4});
  const auto u = all_points(design);
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t d = 0; d < 40; ++d) {
      std::set<int> intervals;
      for (std::size_t i = 0; i < 128; ++i)
        intervals.insert(static_cast<int>(u[(r * 128 + i) * 40 + d] * 128.0));
      EXPECT_EQ(intervals.size(), 128U) << r << " " << d;
    }
}
INSTANTIATE_TEST_SUITE_P(Designs, Stratified,
                         testing::Values(SamplingDesign::latin_hypercube, SamplingDesign::sobol));

// First lines of Joe and Kuo's file new-joe-kuo-6.21201: degree s, inner coefficients a of the primitive
// polynomial, first numbers m; the rest by the recurrence of Bratley and Fox (ACM TOMS 14, 1988).
TEST(SobolPoints, DirectionsAreThoseOfJoeAndKuo) {
  struct Line {
    std::size_t s;
    unsigned a;
    std::uint32_t m[4];
  };
  const Line lines[] = {
      {1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}, {3, 2, {1, 1, 1}}, {4, 1, {1, 1, 3, 3}}};
  const auto known = sobol_directions(6);
  for (std::size_t j = 0; j < 32; ++j)
    EXPECT_EQ(known[j * 6], 0x80000000U >> j);
  for (std::size_t d = 1; d < 6; ++d) {
    const Line& line = lines[d - 1];
    std::uint32_t v[32];
    for (std::size_t j = 0; j < 32; ++j) {
      if (j < line.s) {
        v[j] = line.m[j] << (31 - j);
      } else {
        v[j] = v[j - line.s] ^ (v[j - line.s] >> line.s);
        for (std::size_t k = 1; k < line.s; ++k)
          if ((line.a >> (line.s - 1 - k)) & 1)
            v[j] ^= v[j - k];
      }
      EXPECT_EQ(known[j * 6 + d], v[j]) << d << " " << j;
    }
  }
}

// Dimensions 0 and 1 form a (0, m, 2)-net: every box of 2^-a × 2^-(6−a) holds one of 64 points; scrambling
// keeps that.
TEST(SobolPoints, ScramblingKeepsTheNet) {
  const SobolPoints sobol(2, 99, 3);
  std::vector<double> u(128);
  sobol.points(0, 64, u);
  for (int a = 0; a <= 6; ++a) {
    std::set<int> boxes;
    for (std::size_t i = 0; i < 64; ++i)
      boxes.insert((static_cast<int>(u[2 * i] * (1 << a)) << 6) +
                   static_cast<int>(u[2 * i + 1] * (1 << (6 - a))));
    EXPECT_EQ(boxes.size(), 64U) << a;
  }
}

// The mean of a smooth function of 5 numbers: random sampling would err by 0.65/sqrt(1024) = 0.02 (one
// standard deviation of the product is 0.65); a net of 1024 points errs by much less. 16 scramblings, root
// mean square.
TEST(SobolPoints, SmoothMeansConvergeFasterThanRandomOnes) {
  double square = 0.0;
  for (std::uint64_t lane = 0; lane < 16; ++lane) {
    const SobolPoints sobol(5, 1, lane);
    std::vector<double> u(1024 * 5);
    sobol.points(0, 1024, u);
    double sum = 0.0;
    for (std::size_t i = 0; i < 1024; ++i) {
      double product = 1.0;
      for (std::size_t d = 0; d < 5; ++d)
        product *= 0.5 + u[5 * i + d];
      sum += product;
    }
    square += std::pow(sum / 1024 - 1.0, 2) / 16;
  }
  EXPECT_LT(std::sqrt(square), 0.002);
}

TEST(SampleDesign, RefusesSizesThatTheDesignCannotHave) {
  const auto message = [](const DesignPlan& plan) -> std::string {
    try {
      const SampleDesign design(plan);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({.design = SamplingDesign::sobol, .samples = 1600, .dimensions = 2}),
            "Sobol' designs want a power of two: 1600 samples in 16 randomisations are 100 each; take 2048");
  EXPECT_EQ(message({.design = SamplingDesign::latin_hypercube, .samples = 100, .dimensions = 2}),
            "100 samples cannot be cut into 16 equal randomisations; take 112");
  EXPECT_EQ(
      message(
          {.design = SamplingDesign::latin_hypercube, .samples = 16, .dimensions = 2, .randomisations = 1}),
      "intervals of this design come from its randomisations: at least 2 are needed (16 are usual), got 1");
  EXPECT_EQ(message({.design = SamplingDesign::sobol, .samples = 1024, .dimensions = 4000}),
            "Sobol' points exist for 1 to 3667 dimensions here, asked for 4000; take design = \"random\"");
}

} // namespace
} // namespace strainwave
