// The exported deck: what it says, and that CalculiX gives our fields for it.

#include "strainwave/model/export/cup_deck.hpp"

#include "strainwave/model/flexspline/calculix.hpp"
#include "strainwave/model/flexspline/cyclic_field.hpp"
#include "strainwave/model/flexspline/ring.hpp"
#include "tests/model/export/folder.hpp"
#include "tests/model/flexspline/bodies.hpp"
#include "tests/support/calculix_output.hpp"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

namespace strainwave {
namespace {

Gear broad_gear() {
  Gear gear = seed_gear();
  const ResponseRequest request = testing_bodies::broad_toothed_cup();
  gear.flexspline = request.flexspline;
  gear.material = request.material;
  gear.mesh = request.mesh;
  return gear;
}

struct NodalLoad {
  int node = 0, component = 0;
  double force = 0.0;
};

std::vector<NodalLoad> loads_of(const std::string& deck) {
  std::vector<NodalLoad> loads;
  std::istringstream in(deck);
  std::string line;
  bool inside = false;
  while (std::getline(in, line)) {
    if (line.starts_with("*")) {
      inside = line.starts_with("*CLOAD");
    } else if (inside) {
      NodalLoad load;
      char comma;
      std::istringstream(line) >> load.node >> comma >> load.component >> comma >> load.force;
      loads.push_back(load);
    }
  }
  return loads;
}

TEST(Deck, header_says_what_the_deck_is) {
  const auto deck = calculix_deck(broad_gear(), {.tooth = -3, .flank_height = 1.0});
  ASSERT_TRUE(deck.ok());
  const std::string head = deck->substr(0, deck->find("*NODE"));
  for (const char* word : {"seed 140/142", "20 sectors", "C3D20R", "1 N towards larger angles", "tooth -3",
                           "flank coordinate 1", "mm, N, MPa"})
    EXPECT_NE(head.find(word), std::string::npos) << word << "\n" << head;
  std::istringstream lines(head);
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(line.starts_with("**")) << line;
}

TEST(Deck, unit_load_turns_with_its_tooth_and_has_its_lever_arm) {
  const Gear gear = broad_gear();
  const SectorMesh mesh = sector_mesh(gear.flexspline, gear.mesh).value();
  for (const double height : {0.0, 0.5, 0.7, 1.0}) {
    const auto deck = calculix_deck(gear, {.tooth = 5, .flank_height = height}); // a quarter turn: 20 teeth
    ASSERT_TRUE(deck.ok());
    const RingPart ring(mesh);
    const std::vector<CartesianPoint> points = ring.points();
    double sum[3] = {}, torque = 0.0;
    for (const NodalLoad& load : loads_of(*deck)) {
      sum[load.component - 1] += load.force;
      const CartesianPoint& p = points[static_cast<std::size_t>(load.node - 1)];
      torque += load.force * (load.component == 1 ? -p.y : load.component == 2 ? p.x : 0.0);
    }
    // Resultant 1 N along the circumferential direction of the flank points, about 90° + half a tooth.
    EXPECT_NEAR(std::hypot(sum[0], sum[1]), 1.0, 1e-4); // the direction turns a little over the flank
    EXPECT_LT(sum[0], -0.99);
    EXPECT_NEAR(sum[2], 0.0, 1e-12);
    const double root = gear.flexspline.root_radius_mm, tip = gear.flexspline.tip_radius_mm;
    EXPECT_GT(torque, root - 1e-3);
    EXPECT_LT(torque, tip + 1e-3);
  }
}

TEST(Deck, radial_load_points_outwards) {
  const auto deck = calculix_deck(broad_gear(), {.tooth = 0, .flank_height = 0.5, .radial = true});
  ASSERT_TRUE(deck.ok());
  double x = 0.0;
  for (const NodalLoad& load : loads_of(*deck))
    x += load.component == 1 ? load.force : 0.0;
  EXPECT_GT(x, 0.99);
}

TEST(Deck, calculix_gives_the_fields_of_this_program) {
  if (std::system("command -v ccx > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "ccx (package calculix-ccx) is not installed";
  // Contact-like loads: an uneven set of wall and flank functionals on both lobes.
  const Gear gear = broad_gear();
  ContactStates states;
  states.request = testing_bodies::broad_toothed_cup();
  ContactForces state;
  state.name = "assembled";
  const SectorMesh mesh = sector_mesh(gear.flexspline, gear.mesh).value();
  const ResponseFunctionals plan = response_functionals(states.request, mesh);
  for (const int lobe : {0, 10}) {
    state.forces.push_back({lobe, plan.layout.wall(0, 1, UnitResponses::radial), 3.0});
    state.forces.push_back({lobe + 1, plan.layout.wall(1, 0, UnitResponses::radial), 2.0});
    state.forces.push_back({lobe, plan.layout.flank(2, 0, UnitResponses::circumferential), -5.0});
  }
  states.states.push_back(state);
  const auto deck = calculix_deck(gear, states);
  ASSERT_TRUE(deck.ok());
  const testing_export::TemporaryFolder folder;
  std::ofstream(folder / "cup.inp") << *deck;
  ASSERT_EQ(
      std::system(("cd '" + folder.path.string() + "' && OMP_NUM_THREADS=1 ccx cup > log.txt 2>&1").c_str()),
      0);
  std::ifstream printed(folder / "cup.dat");
  const RingPart ring(mesh);
  const auto steps = testing_support::read_calculix_displacements(printed, ring.nodes());
  ASSERT_EQ(steps.size(), 1u);

  std::vector<FieldLoad> loads;
  for (const FunctionalForce& force : state.forces)
    loads.push_back(
        {&plan.functionals[static_cast<std::size_t>(force.functional)], force.sector, force.force_n});
  const RingField field = ring_field(mesh, gear.material, {loads});
  const std::vector<double> angles = ring.angles();
  double worst = 0.0;
  for (std::size_t n = 0; n < angles.size(); ++n) {
    const Eigen::Vector3d u = field.displacement.col(0).segment<3>(static_cast<Eigen::Index>(3 * n));
    const double c = std::cos(angles[n]), s = std::sin(angles[n]);
    worst = std::max({worst, std::fabs(c * u[0] - s * u[1] - steps[0][3 * n]),
                      std::fabs(s * u[0] + c * u[1] - steps[0][3 * n + 1]),
                      std::fabs(u[2] - steps[0][3 * n + 2])});
  }
  EXPECT_LT(worst, 5e-6 * field.displacement.cwiseAbs().maxCoeff()); // seven printed digits
}

} // namespace
} // namespace strainwave
