// The seed cup with its teeth against an independent CalculiX model: tests/reference/unit-responses.json. Its
// tooth loads are lines along the face at one height, its wall loads point forces; ours are hats. So
// responses at the loaded place itself (k = 0) differ by the footprint and are left out; everything further
// away must agree.

#include "bodies.hpp"
#include "model/flexspline/responses.hpp"

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
  /// Flank level of ours for each of the reference's: 14.37 mm is the middle hat, 14.584 mm the tip's half
  /// hat.
  static int level(int n) { return ours.flank(n == 0 ? 2 : 4, 0, UnitResponses::circumferential); }

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
        const double own = ours(k, level(response), level(load)) + ours(k + 70, level(response), level(load));
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
          worst =
              std::max(worst, std::fabs(ours(k, ours.wall(station, row, UnitResponses::radial), level(load)) -
                                        theirs));
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
  EXPECT_NEAR(ours(0, level(0), level(0)), theirs, 1e-3 * theirs);
}

} // namespace
} // namespace strainwave
