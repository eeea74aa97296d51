// The seed cup with its teeth against an independent CalculiX model: tests/reference/unit-responses.json. Its
// tooth loads are lines along the face at one height, its wall loads point forces; ours are hats. So
// responses at the loaded place itself (k = 0) differ by the footprint and are left out; everything further
// away must agree.

#include "strainwave/model/flexspline/responses.hpp"
#include "tests/model/flexspline/bodies.hpp"

#include <array>
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace strainwave {
namespace {

class CupReference : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    std::ifstream in(STRAINWAVE_TEST_REFERENCE "/unit-responses.json");
    reference = nlohmann::json::parse(in);
    ResponseRequest request = testing_bodies::seed_cup();
    request.wall_z_mm = reference["wall_z_mm"].get<std::vector<double>>();
    ours = unit_responses(request).value();
  }
  /// The reference's line at 14.37 mm stands in the middle of the middle hat. Its line at the tip edge
  /// (14.584 mm) lies beyond the centre of the tip's half hat; seen from another tooth a tooth moves as a
  /// rigid body, so the two uppermost hats are extrapolated linearly to the edge.
  static std::array<double, 2> tip_shares() {
    const double upper = ours.flank_centre_mm[4], lower = ours.flank_centre_mm[3];
    const double share = (14.584 - lower) / (upper - lower);
    return {share, 1.0 - share};
  }
  static double tooth_from_tooth(int k, int response, int load) {
    const auto shares = tip_shares();
    double sum = 0.0;
    for (int a = 0; a < (response == 0 ? 1 : 2); ++a)
      for (int b = 0; b < (load == 0 ? 1 : 2); ++b)
        sum += (response == 0 ? 1.0 : shares[static_cast<std::size_t>(a)]) *
               (load == 0 ? 1.0 : shares[static_cast<std::size_t>(b)]) *
               ours(k, flank(response == 0 ? 2 : 4 - a), flank(load == 0 ? 2 : 4 - b));
    return sum;
  }
  static double wall_from_tooth(int k, int wall, int load) {
    if (load == 0)
      return ours(k, wall, flank(2));
    return tip_shares()[0] * ours(k, wall, flank(4)) + tip_shares()[1] * ours(k, wall, flank(3));
  }
  static int flank(int height) { return ours.flank(height, 0, UnitResponses::circumferential); }

  inline static nlohmann::json reference;
  inline static UnitResponses ours;
};

TEST_F(CupReference, pair_sums_of_the_teeth_within_one_percent) {
  for (int load = 0; load < 2; ++load)
    for (int response = 0; response < 2; ++response) {
      const auto theirs =
          reference["tooth_from_tooth"][static_cast<std::size_t>(load)][static_cast<std::size_t>(response)]
              .get<std::vector<double>>();
      ASSERT_EQ(theirs.size(), 140u);
      double worst = 0.0, scale = 0.0;
      for (int k = 0; k < 70; ++k) {
        const double pair = theirs[static_cast<std::size_t>(k)] + theirs[static_cast<std::size_t>(k + 70)];
        scale = std::max(scale, std::fabs(pair));
        if (k == 0)
          continue;
        const double own = tooth_from_tooth(k, response, load) + tooth_from_tooth(k + 70, response, load);
        worst = std::max(worst, std::fabs(own - pair));
      }
      EXPECT_LT(worst, 0.01 * scale) << "load " << load << ", response " << response;
      RecordProperty("pair_sum_" + std::to_string(load) + std::to_string(response),
                     std::to_string(worst / scale));
    }
}

TEST_F(CupReference, wall_from_tooth_within_two_percent) {
  for (int load = 0; load < 2; ++load) {
    double worst = 0.0, scale = 0.0;
    for (int station = 0; station < 2; ++station)
      for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 140; ++k) {
          const double theirs =
              reference["wall_from_tooth"][static_cast<std::size_t>(load)][static_cast<std::size_t>(station)]
                       [static_cast<std::size_t>(row)][static_cast<std::size_t>(k)];
          scale = std::max(scale, std::fabs(theirs));
          worst = std::max(
              worst,
              std::fabs(wall_from_tooth(k, ours.wall(station, row, UnitResponses::radial), load) - theirs));
        }
    EXPECT_LT(worst, 0.02 * scale) << "load " << load;
    RecordProperty("wall_from_tooth_" + std::to_string(load), std::to_string(worst / scale));
  }
}

TEST_F(CupReference, wall_from_wall_within_two_percent) {
  double worst = 0.0, scale = 0.0;
  for (int load = 0; load < 6; ++load)
    for (int station = 0; station < 2; ++station)
      for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 140; ++k) {
          const double theirs =
              reference["wall_from_wall"][static_cast<std::size_t>(load)][static_cast<std::size_t>(station)]
                       [static_cast<std::size_t>(row)][static_cast<std::size_t>(k)];
          scale = std::max(scale, std::fabs(theirs));
          if (k == 0)
            continue; // the loaded point itself
          const int response = ours.wall(station, row, UnitResponses::radial);
          worst = std::max(
              worst,
              std::fabs(ours(k, response, ours.wall(load / 3, load % 3, UnitResponses::radial)) - theirs));
        }
  EXPECT_LT(worst, 0.02 * scale);
  RecordProperty("wall_from_wall", std::to_string(worst / scale));
}

TEST_F(CupReference, at_mid_height_even_the_loaded_tooth_agrees) {
  // The middle hat is narrow against the tooth's height: 0.1 % of the free cup's largest response.
  const double theirs = reference["tooth_from_tooth"][0][0][0];
  EXPECT_NEAR(ours(0, flank(2), flank(2)), theirs, 1e-3 * theirs);
}

} // namespace
} // namespace strainwave
