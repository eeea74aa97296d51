#include "strainwave/model/flexspline/mesh.hpp"

#include "strainwave/model/flexspline/element.hpp"
#include "strainwave/model/flexspline/ring.hpp"
#include "strainwave/model/flexspline/tooth_outline.hpp"
#include "tests/model/flexspline/bodies.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double pi = std::numbers::pi;

SectorMesh seed_mesh() {
  const Gear seed = seed_gear();
  return sector_mesh(seed.flexspline, seed.mesh).value();
}

double volume(const SectorMesh& mesh, Region region) {
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (mesh.region[e] == region)
      for (const Eigen::Vector3d& local : hexahedron_integration_points())
        sum += (hexahedron_shape_gradient(local).transpose() * element_points(mesh, static_cast<int>(e)))
                   .determinant();
  return sum;
}

TEST(SectorMesh, seed_counts_are_those_of_the_reference) {
  // tests/reference/unit-responses.json: 20160 elements, 141120 nodes.
  const SectorMesh mesh = seed_mesh();
  EXPECT_EQ(mesh.sectors, 140);
  EXPECT_EQ(mesh.ring_elements(), 20160u);
  EXPECT_EQ(mesh.ring_nodes(), 141120u);
}

TEST(SectorMesh, tooth_outline_agrees_with_involute_functions) {
  // Half angle = θ_h + inv α0 − inv α(ρ), cos α(ρ) = r_b/ρ (any textbook of gearing).
  const Flexspline f = seed_gear().flexspline;
  const double alpha0 = 20.0 * pi / 180.0, base = 14.0 * std::cos(alpha0);
  const auto inv = [](double a) { return std::tan(a) - a; };
  const double theta = (pi / 2.0 + 2.0 * f.profile_shift * std::tan(alpha0)) / 140;
  for (const double radius : {13.9, 14.156, 14.37, 14.584})
    EXPECT_NEAR(tooth_half_angle(f, radius), theta + inv(alpha0) - inv(std::acos(base / radius)), 1e-15);
  EXPECT_EQ(tooth_half_angle(f, 0.9 * base), tooth_half_angle(f, 0.5 * base)); // radial below the base circle
}

TEST(SectorMesh, drive_flank_nodes_lie_on_the_involute_at_larger_angles) {
  const SectorMesh mesh = seed_mesh();
  const Flexspline f = seed_gear().flexspline;
  EXPECT_EQ(mesh.drive_flank.size(), 2u * 6u);
  for (const ElementFace& face : mesh.drive_flank) {
    EXPECT_EQ(
        face.side,
        5); // 3-7-8-4 in CalculiX's count from one: corners 2, 3, 6, 7 and edges 10, 14, 18, 19 from zero
    for (const std::size_t a : {2u, 3u, 6u, 7u, 10u, 14u, 18u, 19u}) {
      const CylinderPoint& p =
          mesh.nodes[static_cast<std::size_t>(mesh.elements[static_cast<std::size_t>(face.element)][a])];
      EXPECT_NEAR(p.angle, tooth_half_angle(f, p.radius), 1e-15);
    }
  }
}

TEST(SectorMesh, volumes_are_those_of_the_cup) {
  // Quadratic sides follow the circles to the fourth order of the element's angle; the tooth's section is
  // integrated by Simpson's rule on 2000 intervals here, by parabolas there (curved flank: 1e-6).
  const SectorMesh mesh = seed_mesh();
  const Flexspline f = seed_gear().flexspline;
  const auto annulus = [](double inner, double outer) { return pi * (outer * outer - inner * inner) / 140; };
  const double inner = 13.856, outer = 14.156;
  EXPECT_NEAR(volume(mesh, Region::wall), annulus(inner, outer) * (21.5 - 0.15), 1e-8);
  EXPECT_NEAR(volume(mesh, Region::rim), annulus(inner, outer) * 6.0, 1e-8);
  EXPECT_NEAR(volume(mesh, Region::front), annulus(inner, outer) * 0.5, 1e-8);
  EXPECT_NEAR(volume(mesh, Region::diaphragm), annulus(5.0, inner) * 0.3, 1e-8);
  EXPECT_NEAR(volume(mesh, Region::corner), annulus(inner, outer) * 0.3, 1e-8);
  double section = 0.0;
  const int intervals = 2000;
  for (int n = 0; n <= intervals; ++n) {
    const double radius = f.root_radius_mm + (f.tip_radius_mm - f.root_radius_mm) * n / intervals;
    const double weight = n == 0 || n == intervals ? 1.0 : n % 2 == 1 ? 4.0 : 2.0;
    section += weight * 2.0 * radius * tooth_half_angle(f, radius);
  }
  section *= (f.tip_radius_mm - f.root_radius_mm) / (3.0 * intervals);
  EXPECT_NEAR(volume(mesh, Region::tooth), section * 6.0, 1e-5 * section * 6.0);
}

TEST(SectorMesh, boundaries_lie_in_the_gaps_and_match) {
  const SectorMesh mesh = seed_mesh();
  for (std::size_t b = 0; b < mesh.left.size(); ++b) {
    const CylinderPoint& left = mesh.nodes[static_cast<std::size_t>(mesh.left[b])];
    const CylinderPoint& right = mesh.nodes[static_cast<std::size_t>(mesh.right[b])];
    EXPECT_NEAR(left.angle, -pi / 140, 1e-15);
    EXPECT_EQ(left.angle, -right.angle);
    EXPECT_EQ(left.radius, right.radius);
    EXPECT_EQ(left.z, right.z);
    EXPECT_LE(right.radius, 14.156 + 1e-12) << "no tooth in the middle of the gap";
    EXPECT_EQ(mesh.ring_node(mesh.right[b], 139), mesh.ring_node(mesh.left[b], 0));
  }
}

TEST(SectorMesh, ring_numbers_are_a_permutation) {
  const ResponseRequest cup = testing_bodies::broad_toothed_cup();
  const SectorMesh mesh = sector_mesh(cup.flexspline, cup.mesh).value();
  std::set<int> numbers;
  for (int j = 0; j < mesh.sectors; ++j)
    for (int i = 0; i < static_cast<int>(mesh.nodes.size()); ++i)
      numbers.insert(mesh.ring_node(i, j));
  EXPECT_EQ(numbers.size(), mesh.ring_nodes());
  EXPECT_EQ(*numbers.begin(), 0);
  EXPECT_EQ(*numbers.rbegin(), static_cast<int>(mesh.ring_nodes()) - 1);
}

TEST(SectorMesh, an_open_part_has_its_own_last_plane) {
  const SectorMesh mesh = seed_mesh();
  const RingPart part(mesh, 3);
  EXPECT_FALSE(part.closed());
  EXPECT_EQ(part.nodes(), 3 * mesh.owned() + static_cast<int>(mesh.right.size()));
  const std::vector<CartesianPoint> points = part.points();
  for (const int right : mesh.right) {
    const CartesianPoint expected = mesh.node(right, 2),
                         found = points[static_cast<std::size_t>(part.node(right, 2))];
    EXPECT_NEAR(found.x, expected.x, 1e-12);
    EXPECT_NEAR(found.y, expected.y, 1e-12);
  }
}

TEST(SectorMesh, smooth_cup_takes_any_number_of_sectors) {
  const Gear seed = seed_gear();
  const SectorMesh mesh = sector_mesh(seed.flexspline, seed.mesh, {.teeth = false, .sectors = 144}).value();
  EXPECT_EQ(mesh.sectors, 144);
  EXPECT_TRUE(mesh.drive_flank.empty());
  EXPECT_EQ(mesh.inner_wall.size(), 4u * (14 + 6 + 1));
}

TEST(SectorMesh, a_rim_thicker_than_the_wall_steps_at_45_degrees_behind_the_face) {
  Gear gear = seed_gear();
  gear.flexspline.wall_thickness_mm = 0.25;
  const SectorMesh mesh = sector_mesh(gear.flexspline, gear.mesh).value();
  EXPECT_EQ(mesh.elements.size(), 144u + 4u);
  double step = 0.0;
  for (const CylinderPoint& p : mesh.nodes) {
    if (p.z < 1.0)
      continue;
    if (p.z <= 21.45 + 1e-12) {
      EXPECT_LE(p.radius, 13.856 + 0.25 + 1e-12);
    }
    if (p.z < 21.5 && p.z > 21.45)
      step = std::max(step, p.radius - 13.856 - 0.25 - (p.z - 21.45));
  }
  EXPECT_NEAR(step, 0.0, 1e-12);
}

struct Contradiction {
  const char* words;
  void (*change)(Gear&);
};

TEST(SectorMesh, contradicting_numbers_have_a_sentence) {
  const Contradiction cases[] = {
      {"pointed", [](Gear& g) { g.flexspline.tip_radius_mm = 14.8; }},
      {"overlap", [](Gear& g) { g.flexspline.profile_shift = 3.2; }},
      {"tip radius", [](Gear& g) { g.flexspline.tip_radius_mm = 14.1; }},
      {"boss", [](Gear& g) { g.flexspline.boss_radius_mm = 13.9; }},
      {"no wall", [](Gear& g) { g.flexspline.cup_length_mm = 6.0; }},
      {"per_pitch", [](Gear& g) { g.mesh.per_pitch = 2; }},
      {"at least 1", [](Gear& g) { g.mesh.along_wall = 0; }},
      {"thickness", [](Gear& g) { g.flexspline.wall_thickness_mm = 0.0; }},
  };
  for (const Contradiction& each : cases) {
    Gear gear = seed_gear();
    each.change(gear);
    const Outcome<SectorMesh> mesh = sector_mesh(gear.flexspline, gear.mesh);
    ASSERT_FALSE(mesh.ok()) << each.words;
    EXPECT_NE(mesh.failure().message.find(each.words), std::string::npos) << mesh.failure().message;
  }
}

} // namespace
} // namespace strainwave
