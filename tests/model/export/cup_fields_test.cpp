// The cup's fields against the contact analysis that made the forces: an independent way to the same
// displacements, through the finite elements of the whole ring instead of the unit responses.

#include "strainwave/model/export/cup_fields.hpp"

#include "strainwave/model/flexspline/ring.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "tests/model/export/folder.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

/// Displacement of a tooth's contact towards larger φ: linear between the two flank hats around its radius.
double tooth_displacement(const RingPart& ring, const ResponseFunctionals& plan, const LoadedPoint& tooth,
                          const Eigen::Ref<const Eigen::VectorXd>& displacement) {
  const std::vector<double>& radius = plan.layout.flank_radius_mm;
  std::size_t below = 0;
  while (below + 2 < radius.size() && radius[below + 1] < tooth.flank_radius_mm)
    ++below;
  const double share =
      std::clamp((tooth.flank_radius_mm - radius[below]) / (radius[below + 1] - radius[below]), 0.0, 1.0);
  const int sector = (tooth.tooth + ring.sectors()) % ring.sectors();
  const auto at = [&](std::size_t height) {
    const int functional =
        tooth.coast ? plan.layout.coast(static_cast<int>(height), 0, UnitResponses::circumferential)
                    : plan.layout.flank(static_cast<int>(height), 0, UnitResponses::circumferential);
    return ring.measure(plan.functionals[static_cast<std::size_t>(functional)], sector, displacement);
  };
  return (1.0 - share) * at(below) + share * at(below + 1);
}

TEST(CupFields, wall_moves_as_in_the_contact_analysis) {
  ForwardModel model({.disk_cache = false});
  const auto states = model.contact_states(testing_export::coarse_seed());
  ASSERT_TRUE(states.ok()) << states.failure().message;
  ASSERT_EQ(states->states.size(), 3u);
  const auto fields = cup_fields(*states);
  ASSERT_TRUE(fields.ok());
  EXPECT_EQ(fields->names, (std::vector<std::string>{"assembled", "loaded_1Nm", "loaded_7Nm"}));
  EXPECT_LT(fields->field.residual, 1e-8);
  EXPECT_LT(fields->contact_difference_mm, 1e-8); // of 0.25 mm
}

TEST(CupFields, closed_wall_stations_touch_the_disc) {
  const Gear gear = testing_export::coarse_seed();
  ForwardModel model({.disk_cache = false});
  const auto states = model.contact_states(gear);
  ASSERT_TRUE(states.ok());
  const auto fields = cup_fields(*states);
  ASSERT_TRUE(fields.ok());
  const ResponseFunctionals plan = response_functionals(states->request, fields->mesh);
  const RingPart ring(fields->mesh);
  const auto summary = model.analyze(gear, Want::backlash).wave_generator.value();
  const double inner = gear.flexspline.neutral_radius_mm - gear.flexspline.rim_thickness_mm / 2.0;
  const double disc = summary.disc_radius_mm - gear.flexspline.rim_thickness_mm / 2.0;
  int closed = 0;
  for (std::size_t c = 0; c < states->states.size(); ++c)
    for (const WallContact& wall : states->states[c].wall) {
      double w = 0.0, v = 0.0;
      for (const FunctionalForce& part : wall.average) {
        const auto f = static_cast<std::size_t>(part.functional);
        const auto u = fields->field.displacement.col(static_cast<Eigen::Index>(c));
        v += part.force_n * ring.measure(plan.functionals[f], part.sector, u);
        w += part.force_n * ring.measure(plan.functionals[f + 1], part.sector, u);
      }
      const double phi = wall.station.phi_rad, cs = std::cos(phi), sn = std::sin(phi);
      const double gap =
          std::hypot((inner + w) * cs - v * sn - summary.eccentricity_mm, (inner + w) * sn + v * cs) - disc;
      EXPECT_GT(gap, -1e-8);
      if (wall.radial_n > 0.0) {
        ++closed;
        EXPECT_NEAR(gap, 0.0, 1e-8);
      }
    }
  EXPECT_GT(closed, 60);
}

TEST(CupFields, loaded_teeth_move_by_what_the_rotation_closes) {
  const Gear gear = testing_export::coarse_seed();
  ForwardModel model({.disk_cache = false});
  const auto states = model.contact_states(gear);
  ASSERT_TRUE(states.ok());
  const auto fields = cup_fields(*states);
  ASSERT_TRUE(fields.ok());
  const ResponseFunctionals plan = response_functionals(states->request, fields->mesh);
  const RingPart ring(fields->mesh);
  const Eigen::VectorXd change = fields->field.displacement.col(2) - fields->field.displacement.col(0);
  const ContactForces& loaded = states->states[2];
  int engaged = 0;
  double torque = 0.0;
  for (const ToothContact& contact : loaded.teeth) {
    const LoadedPoint& tooth = contact.tooth;
    // gap = c + d − R θ, d towards smaller φ, counted from the assembled state
    const double gap = tooth.backlash_mm - tooth_displacement(ring, plan, tooth, change) -
                       tooth.contact_radius_mm * loaded.rotation_rad;
    torque += 2e-3 * contact.force_n * tooth.contact_radius_mm;
    EXPECT_GT(gap, -1e-8) << "tooth " << tooth.tooth;
    if (contact.force_n > 0.0) {
      ++engaged;
      EXPECT_NEAR(gap, 0.0, 1e-8) << "tooth " << tooth.tooth;
    }
  }
  EXPECT_GT(engaged, 4);
  EXPECT_NEAR(torque, 7.0, 1e-9);
}

TEST(CupFields, wedged_teeth_touch_on_both_flanks) {
  Gear gear = testing_export::coarse_seed();
  gear.circular_spline.profile_shift = 2.12; // 1.5 µm of interference
  gear.load.torque_nm = {1.0};
  ForwardModel model({.disk_cache = false});
  const auto states = model.contact_states(gear);
  ASSERT_TRUE(states.ok()) << states.failure().message;
  const auto fields = cup_fields(*states);
  ASSERT_TRUE(fields.ok());
  const ResponseFunctionals plan = response_functionals(states->request, fields->mesh);
  const RingPart ring(fields->mesh);
  const Eigen::VectorXd change = fields->field.displacement.col(1) - fields->field.displacement.col(0);
  const ContactForces& loaded = states->states[1];
  int driving = 0, coasting = 0;
  double torque = 0.0;
  for (const ToothContact& contact : loaded.teeth) {
    const LoadedPoint& tooth = contact.tooth;
    // Towards larger φ the tooth moves into the drive flank and away from the coast flank; θ does the
    // opposite.
    const double away =
        tooth_displacement(ring, plan, tooth, change) + tooth.contact_radius_mm * loaded.rotation_rad;
    const double gap = tooth.backlash_mm + (tooth.coast ? away : -away);
    torque += (tooth.coast ? -2e-3 : 2e-3) * contact.force_n * tooth.contact_radius_mm;
    EXPECT_GT(gap, -1e-8) << "tooth " << tooth.tooth;
    if (contact.force_n > 0.0) {
      (tooth.coast ? coasting : driving) += 1;
      EXPECT_NEAR(gap, 0.0, 1e-8) << "tooth " << tooth.tooth;
    }
  }
  EXPECT_GT(driving, 1);
  EXPECT_GT(coasting, 1);
  EXPECT_NEAR(torque, 1.0, 1e-9);
}

TEST(CupFields, linear_fidelity_keeps_the_closed_wall_where_assembly_put_it) {
  Gear gear = testing_export::coarse_seed();
  gear.contact.fidelity = Fidelity::linear;
  gear.load.torque_nm = {7.0};
  ForwardModel model({.disk_cache = false});
  const auto states = model.contact_states(gear);
  ASSERT_TRUE(states.ok()) << states.failure().message;
  const auto fields = cup_fields(*states);
  ASSERT_TRUE(fields.ok());
  EXPECT_LT(fields->contact_difference_mm, 1e-8);
  const ContactForces &assembled = states->states[0], &loaded = states->states[1];
  double tension = 0.0;
  for (std::size_t i = 0; i < assembled.wall.size(); ++i) {
    const WallContact &before = assembled.wall[i], &after = loaded.wall[i];
    if (before.radial_n == 0.0)
      continue;
    const double force = std::hypot(before.radial_n, before.circumferential_n);
    const double along = (before.radial_n * (after.radial_mm - before.radial_mm) +
                          before.circumferential_n * (after.circumferential_mm - before.circumferential_mm)) /
                         force;
    EXPECT_NEAR(along, 0.0, 1e-8);
    tension = std::min(tension, after.radial_n);
  }
  EXPECT_LT(tension, 0.0); // what this fidelity is known for at rated torque
}

TEST(CupFields, unlike_lobes_are_loaded_one_by_one) {
  Gear gear = testing_export::coarse_seed();
  gear.contact.lobes = 1;
  gear.load.torque_nm = {2.0};
  ForwardModel model({.disk_cache = false});
  const auto states = model.contact_states(gear);
  ASSERT_TRUE(states.ok()) << states.failure().message;
  const auto fields = cup_fields(*states);
  ASSERT_TRUE(fields.ok());
  EXPECT_LT(fields->contact_difference_mm, 1e-8);
}

TEST(CupFields, grid_carries_every_state) {
  ForwardModel model({.disk_cache = false});
  Gear gear = testing_export::coarse_seed();
  gear.load.torque_nm = {7.0};
  const auto fields = cup_fields(*model.contact_states(gear));
  ASSERT_TRUE(fields.ok());
  const UnstructuredGrid grid = field_grid(*fields);
  std::vector<std::string> names;
  for (const GridArray& array : grid.point_data)
    names.push_back(array.name);
  for (const GridArray& array : grid.cell_data)
    names.push_back(array.name);
  for (const char* name : {"tooth", "assembled_displacement_mm", "assembled_contact_force_n",
                           "loaded_7Nm_displacement_mm", "loaded_7Nm_contact_force_n", "region", "sector",
                           "assembled_von_mises_mpa", "loaded_7Nm_von_mises_mpa"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  // The nodal forces on the wall add up to the disc forces, equal and opposite: nothing in sum; the torque
  // of the teeth is what the bore holds.
  const auto& force = std::get<std::vector<double>>(grid.point_data.back().values);
  double x = 0.0, y = 0.0, torque = 0.0, size = 0.0;
  for (std::size_t n = 0; n < grid.points.size() / 3; ++n) {
    x += force[3 * n];
    y += force[3 * n + 1];
    size += std::hypot(force[3 * n], force[3 * n + 1]);
    torque += grid.points[3 * n] * force[3 * n + 1] - grid.points[3 * n + 1] * force[3 * n];
  }
  EXPECT_LT(std::hypot(x, y), 1e-10 * size);
  EXPECT_LT(torque, -6000.0); // N·mm: 7 N·m towards smaller φ, less what the discs' frictionless hold turns
}

} // namespace
} // namespace strainwave
