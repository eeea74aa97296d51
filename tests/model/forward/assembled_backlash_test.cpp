// Backlash over φ and face of the coned cup: the independent figures of three sections, and what results say
// of it.

#include "strainwave/model/export/result_json.hpp"
#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/meshing/assembled_backlash.hpp"
#include "strainwave/model/meshing/gear_surface.hpp"
#include "tests/support/coarse_seed.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace strainwave {
namespace {

TEST(AssembledBacklash, FallsFromTheRearToTheFrontOfTheDiscsAsAnIndependentModelSays) {
  // Linear finite elements, another program: +3.8 µm at the rear edge of the discs, −3.2 µm mid face, −11.5
  // µm at the front edge, printed with one digit; meshes differ, and 1 µm of radial displacement is worth
  // 0.45 µm of backlash.
  const Gear gear = seed_gear();
  const UnitResponses responses = unit_responses(response_request(gear)).value();
  const RingCompliance ring(responses, contact_rows(gear), true);
  const NeutralCurve curve = NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
  ContactSolver solver;
  const AssembledState assembled = assemble(ring, surface_of(gear, curve), 0.0, solver).value();
  const std::vector<FlankPair> flanks(3, FlankPair::make(gear).value());
  const std::vector<double> z = {22.5, 24.5, 26.5};
  const AssembledPoses poses(ring, assembled, 14.006, 0.0, z);
  const Backlash teeth = backlash(gear, curve).value();
  const std::vector<double> expected = {3.8, -3.2, -11.5};
  for (std::size_t k = 0; k < 3; ++k) {
    const AssembledPoses one(ring, assembled, 14.006, 0.0, {z[k]});
    const AssembledBacklash map = assembled_backlash(one, {flanks[k]}, {z[k]}, teeth.phi_rad, 140.0 / 142.0);
    EXPECT_NEAR(map.min_um, expected[k], 0.3) << z[k];
  }
  const AssembledBacklash map = assembled_backlash(poses, flanks, z, teeth.phi_rad, 140.0 / 142.0);
  EXPECT_NEAR(map.min_um, -11.5, 0.3);
  EXPECT_EQ(map.min_z_mm, 26.5);
  // least over continuous φ: not above any tooth, and not far below the nearest
  double least_of_teeth = 1e9;
  for (const auto& row : map.backlash_um) {
    for (const double c : row) {
      if (std::isfinite(c))
        least_of_teeth = std::min(least_of_teeth, c);
    }
  }
  EXPECT_LE(map.min_um, least_of_teeth);
  EXPECT_GT(map.min_um, least_of_teeth - 1.0);
}

TEST(AssembledBacklash, InterferenceOfAResultIsThatOfItsOwnGaps) {
  Gear gear = testing_support::coarse_seed_gear(); // free in the kinematic section, not so as assembled
  gear.contact.window_deg = {-21.0, 51.0};
  gear.load.torque_nm = {1.0};
  ForwardModel model({.disk_cache = false});
  const auto kinematic = result_json(model.analyze(gear))["backlash"];
  EXPECT_FALSE(kinematic["interference"].get<bool>());
  EXPECT_FALSE(kinematic.contains("assembled"));
  gear.contact.gaps = GapModel::assembled;
  const auto coned = result_json(model.analyze(gear));
  EXPECT_TRUE(coned["backlash"]["interference"].get<bool>());
  EXPECT_NE(coned["message"].get<std::string>().find("z = 27.5"), std::string::npos) << coned["message"];
  const auto& map = coned["backlash"]["assembled"];
  ASSERT_EQ(map["backlash_um"].size(), map["z_mm"].size());
  EXPECT_EQ(map["backlash_um"][0].size(), map["phi_deg"].size());
  EXPECT_EQ(map["z_mm"].front(), 21.5);
  EXPECT_EQ(map["z_mm"].back(), 27.5);
  // ∂c/∂x2 = 75.8 µm per unit
  gear.circular_spline.profile_shift += (1.0 - map["min_um"].get<double>()) / 75.8;
  const auto free = result_json(model.analyze(gear))["backlash"];
  EXPECT_FALSE(free["interference"].get<bool>());
  EXPECT_NEAR(free["assembled"]["min_um"], 1.0, 0.1);
}

} // namespace
} // namespace strainwave
