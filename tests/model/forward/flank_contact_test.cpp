// Contact over flank and face: the selection of points misses none, one point is the source text's model,
// forces converge.

#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/loading/phase_model.hpp"
#include "strainwave/model/meshing/flank_points.hpp"
#include "strainwave/model/meshing/gear_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace strainwave {
namespace {

Gear many_points(int heights, int slices) {
  Gear gear = seed_gear();
  gear.contact.flank_points = heights;
  gear.contact.face_slices = slices;
  gear.contact.window_deg = {-21.0, 51.0};
  gear.load.torque_nm = {7.0};
  return gear;
}

TEST(FlankContact, SelectionGivesTheSolutionOfAllPointsAtOnce) {
  const Gear gear = many_points(5, 3);
  const UnitResponses responses = unit_responses(response_request(gear)).value();
  const RingCompliance ring(responses, contact_rows(gear), true);
  const NeutralCurve curve = NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
  const WaveGeneratorSurface discs = surface_of(gear, curve);
  ContactSolver solver;
  const auto assembled = std::make_shared<const AssembledState>(assemble(ring, discs, 0.0, solver).value());
  std::vector<FlankPair> flanks;
  for (const double z : slice_places(responses)) {
    flanks.push_back(FlankPair::make(gear, face_coordinate(gear.flexspline, z)).value());
  }
  const auto points = flank_points(gear, responses, backlash(gear, curve).value(), flanks,
                                   [&](int, double phi, int) { return curve.pose(phi); });
  ASSERT_GT(points.size(), 200U);

  const PhaseModel model(gear.contact, ring, discs, assembled, points);
  const PhaseLoad load = model.at_torque(7.0, solver).value();
  EXPECT_GT(load.rounds, 1); // the first selection is not enough here

  const LoadProblem all = unilateral_problem(ring, *assembled, points);
  const ContactState start = solver.solve_torque(all.problem, 3.5e3).value();
  const ExactLoad exact =
      correct_to_exact_gap(ring, discs, *assembled, all, start, Control::torque, solver).value();
  EXPECT_NEAR(load.rotation_rad, exact.state.rotation, 1e-12);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(load.force_n[i], exact.state.force(static_cast<Eigen::Index>(i)), 1e-7) << i;
  }
}

TEST(FlankContact, PointsOfAToothAddUpToItsForceAndNoneOverlaps) {
  ForwardModel model({.disk_cache = false});
  const ForwardResult result = model.analyze(many_points(5, 3));
  ASSERT_EQ(result.status, Status::ok) << result.message;
  const LoadResult& load = result.load[0];
  double teeth = 0.0;
  double points = 0.0;
  for (const double f : load.force_n)
    teeth += f;
  for (std::size_t i = 0; i < load.points.force_n.size(); ++i) {
    points += load.points.force_n[i];
    EXPECT_GE(load.points.force_n[i], 0.0);
    EXPECT_GE(load.points.gap_um[i], 0.0);
    EXPECT_TRUE(load.points.force_n[i] == 0.0 || load.points.gap_um[i] == 0.0);
  }
  EXPECT_NEAR(points, teeth, 1e-9 * teeth);
  EXPECT_TRUE(result.certificate->holds());
}

TEST(FlankContact, GapsAreTakenWhereTheHatsMeasure) {
  // the tip's half hat: centroid of 1 − x/step over [0, step] is a third of it; every other height is its own
  EXPECT_DOUBLE_EQ(gap_height(4, 5), 1.0 - 0.25 / 3.0);
  EXPECT_DOUBLE_EQ(gap_height(3, 5), 0.75);
  // so the first contact, at the tip's edge, turns alike for few and for many heights (0.1 %; with the gap at
  // the very tip 0.9 %)
  ForwardModel model({.disk_cache = false});
  const auto rotation = [&](int heights) {
    Gear gear = many_points(heights, 1);
    gear.contact.force_direction.reset(); // along the normal
    gear.load.torque_nm = {1.0};
    return model.analyze(gear).load[0].rotation_rad;
  };
  EXPECT_NEAR(rotation(5), rotation(17), 0.003 * rotation(17));
}

TEST(FlankContactNightly, NineHeightsAndSlicesAreWithinTwoPercent) {
  // docs/flank-contact.md's recommended counts against finer ones, at rated and high torque
  ForwardModel model({.disk_cache = false});
  for (const GapModel gaps : {GapModel::kinematic, GapModel::assembled}) {
    const auto solved = [&](int heights, int slices) {
      Gear gear = many_points(heights, slices);
      gear.contact.force_direction.reset();
      gear.contact.window_deg = {-60.0, 51.0};
      gear.contact.gaps = gaps;
      gear.circular_spline.profile_shift = gaps == GapModel::assembled ? 2.4132 : 2.19;
      gear.load.torque_nm = {7.0, 11.5};
      return model.analyze(gear);
    };
    const ForwardResult usual = solved(9, 9);
    const ForwardResult fine = solved(13, 13);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(usual.load[k].peak_force_n, fine.load[k].peak_force_n, 0.02 * fine.load[k].peak_force_n);
      EXPECT_NEAR(usual.load[k].rotation_rad, fine.load[k].rotation_rad, 0.005 * fine.load[k].rotation_rad);
    }
  }
}

TEST(FlankContact, OnePointIsTheModelWithoutPoints) {
  ForwardModel model({.disk_cache = false});
  const ForwardResult result = model.analyze(many_points(1, 1));
  EXPECT_TRUE(result.load[0].points.tooth.empty());
  // every tooth is loaded where its backlash is least
  EXPECT_EQ(result.load[0].force_n.size(), 28U);
}

TEST(FlankContact, LeadTaperTakesTheConingOut) {
  // The coned cup interferes at the open end; removing material there lowers the interference.
  Gear gear = many_points(5, 5);
  gear.contact.gaps = GapModel::assembled;
  ForwardModel model({.disk_cache = false});
  const double coned = model.analyze(gear).load[0].rotation_rad;
  gear.flank_modification.flexspline.lead_taper_um = 10.0;
  EXPECT_GT(model.analyze(gear).load[0].rotation_rad, coned);
}

TEST(FlankContact, ReferenceSectionMovesTheDiscsUntilU0IsMetThere) {
  Gear gear = many_points(1, 1);
  gear.contact.gaps = GapModel::assembled;
  gear.contact.reference_section_mm = 24.5;
  ForwardModel model({.disk_cache = false});
  const ForwardResult result = model.analyze(gear);
  ASSERT_EQ(result.status, Status::ok) << result.message;
  // as given, the middle stands at 0.217 mm: the discs have to come in by about the excess
  EXPECT_LT(result.assembly->disc_shift_mm, -0.01);
  EXPECT_NEAR(result.assembly->radial_deformation_mm, 0.2, 2e-4); // inner wall beside the neutral surface
  EXPECT_FALSE(std::isnan(result.load[0].peak_force_n));
}

} // namespace
} // namespace strainwave
