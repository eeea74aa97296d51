// The same mesh, element and loads in an independent program: CalculiX (ccx) reads our deck and must print
// our displacements.

#include "strainwave/model/flexspline/calculix.hpp"
#include "tests/support/calculix_output.hpp"

#include "strainwave/model/flexspline/cyclic.hpp"
#include "strainwave/model/flexspline/responses.hpp"
#include "tests/model/flexspline/bodies.hpp"
#include "tests/support/temporary_folder.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace strainwave {
namespace {

namespace fs = std::filesystem;

TEST(Calculix, coarse_cup_with_teeth_agrees_to_the_printed_digits) {
  if (std::system("command -v ccx > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "ccx (package calculix-ccx) is not installed";
  const ResponseRequest request = testing_bodies::broad_toothed_cup();
  const SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
  const ResponseFunctionals plan = response_functionals(request, mesh);
  UnitResponses cyclic = plan.layout;
  cyclic.data = cyclic_responses(mesh, request.material, plan.functionals);
  const std::vector<int> loads = {cyclic.flank(2, 1, UnitResponses::circumferential),
                                  cyclic.flank(1, 0, UnitResponses::radial),
                                  cyclic.wall(1, 1, UnitResponses::radial)};
  const RingPart ring(mesh);
  std::vector<std::vector<DeckLoad>> cases;
  for (const int load : loads)
    cases.push_back({{plan.functionals[static_cast<std::size_t>(load)], 0, 1.0}});

  const testing_support::TemporaryFolder temporary;
  const fs::path folder = temporary.path;
  {
    std::ofstream deck(folder / "cup.inp");
    write_calculix_deck(deck, ring, request.material, cases, "coarse cup");
  }
  const std::string command = "cd '" + folder.string() + "' && OMP_NUM_THREADS=1 ccx cup > ccx.log 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << folder;
  std::ifstream printed(folder / "cup.dat");
  const std::vector<std::vector<double>> steps =
      testing_support::read_calculix_displacements(printed, ring.nodes());
  ASSERT_EQ(steps.size(), loads.size());

  const std::vector<double> angles = ring.angles();
  for (std::size_t step = 0; step < steps.size(); ++step) {
    Eigen::VectorXd u(3 * ring.nodes());
    for (std::size_t n = 0; n < angles.size(); ++n) {
      const double c = std::cos(angles[n]), s = std::sin(angles[n]), ux = steps[step][3 * n],
                   uy = steps[step][3 * n + 1];
      u.segment<3>(static_cast<Eigen::Index>(3 * n)) << c * ux + s * uy, c * uy - s * ux,
          steps[step][3 * n + 2];
    }
    double worst = 0.0, scale = 0.0;
    for (int k = 0; k < mesh.sectors; ++k)
      for (int a = 0; a < cyclic.flank_count() + cyclic.wall_count(); ++a) {
        const double ours = cyclic(k, a, loads[step]);
        scale = std::max(scale, std::fabs(ours));
        worst = std::max(worst,
                         std::fabs(ours - ring.measure(plan.functionals[static_cast<std::size_t>(a)], k, u)));
      }
    EXPECT_LT(worst, 5e-6 * scale) << "load case " << step;
    RecordProperty("relative_difference_" + std::to_string(step), std::to_string(worst / scale));
  }
}

TEST(Calculix, every_number_fits_its_field) {
  const ResponseRequest request = testing_bodies::broad_toothed_cup();
  const SectorMesh mesh = sector_mesh(request.flexspline, request.mesh).value();
  const ResponseFunctionals plan = response_functionals(request, mesh);
  std::ostringstream deck;
  write_calculix_deck(deck, RingPart(mesh, 2), request.material, {{{plan.functionals[0], 0, 1.0}}}, "part");
  std::istringstream lines(deck.str());
  std::string line;
  while (std::getline(lines, line)) {
    if (line.starts_with("*"))
      continue;
    std::istringstream fields(line);
    std::string field;
    int count = 0;
    while (std::getline(fields, field, ',')) {
      EXPECT_LE(field.size() - field.find_first_not_of(' '), 20u) << line;
      ++count;
    }
    EXPECT_LE(count, 16) << line;
  }
}

TEST(Calculix, a_broken_result_file_is_named_by_its_line) {
  std::istringstream text(" displacements (vx,vy,vz) for set ALL and time  0.1E+01\n\n 1  0.1 0.2\n");
  EXPECT_THROW((void)testing_support::read_calculix_displacements(text, 4), std::runtime_error);
}

} // namespace
} // namespace strainwave
