#include "strainwave/model/flexspline/calculix.hpp"

#include <cmath>
#include <ostream>

#include <fmt/format.h>
#include <fmt/ostream.h>

namespace strainwave {

namespace {

constexpr int per_line = 16; ///< entries of a data line

std::string number(double value, double largest) {
  return fmt::format("{:.11e}", std::fabs(value) <= 1e-14 * largest ? 0.0 : value);
}

void write_set(std::ostream& out, const char* name, const std::vector<int>& nodes) {
  fmt::print(out, "*NSET, NSET={}\n", name);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    fmt::print(out, "{}{}", nodes[n] + 1, n % 8 == 7 || n + 1 == nodes.size() ? "\n" : ", ");
}

} // namespace

void write_calculix_deck(std::ostream& out, const RingPart& part, const Material& material,
                         const std::vector<std::vector<DeckLoad>>& cases, const std::string& title) {
  const SectorMesh& mesh = part.mesh();
  const std::vector<CartesianPoint> points = part.points();
  const std::vector<double> angles = part.angles();
  double largest = 0.0;
  for (const CylinderPoint& p : mesh.nodes)
    largest = std::fmax(largest, std::fmax(p.radius, std::fabs(p.z)));
  fmt::print(out,
             "** {}\n** mm, N, MPa; z along the axis, 0 in the middle of the diaphragm\n*NODE, NSET=ALL\n",
             title);
  for (std::size_t n = 0; n < points.size(); ++n)
    fmt::print(out, "{}, {}, {}, {}\n", n + 1, number(points[n].x, largest), number(points[n].y, largest),
               number(points[n].z, largest));
  fmt::print(out, "*ELEMENT, TYPE=C3D20R, ELSET=CUP\n");
  int element = 0;
  for (int j = 0; j < part.sectors(); ++j)
    for (const auto& nodes : mesh.elements) {
      fmt::print(out, "{}", ++element);
      for (std::size_t a = 0; a < 20; ++a)
        fmt::print(out, "{}{}", a + 1 == per_line ? ",\n" : ", ", part.node(nodes[a], j) + 1);
      fmt::print(out, "\n");
    }
  // Fixed degrees of freedom must be whole nodes here: a single cylindrical component has no Cartesian
  // counterpart.
  std::vector<int> held;
  const std::vector<int> fixed = part.fixed();
  for (std::size_t n = 0; n + 2 < fixed.size(); ++n)
    if (fixed[n] % 3 == 0 && fixed[n + 2] == fixed[n] + 2)
      held.push_back(fixed[n] / 3);
  write_set(out, "BOSS", held);
  fmt::print(out,
             "*MATERIAL, NAME=STEEL\n*ELASTIC\n{:.12g}, {:.12g}\n*SOLID SECTION, ELSET=CUP, MATERIAL=STEEL\n",
             material.youngs_modulus_mpa, material.poisson_ratio);
  fmt::print(out, "*BOUNDARY\nBOSS, 1, 3, 0.0\n");
  for (const std::vector<DeckLoad>& loads : cases) {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * part.nodes());
    for (const DeckLoad& load : loads)
      part.add_load(load.functional, load.sector, load.factor, force);
    const double scale = force.cwiseAbs().maxCoeff();
    fmt::print(out, "*STEP\n*STATIC\n*CLOAD, OP=NEW\n");
    for (int n = 0; n < part.nodes(); ++n) {
      const double angle = angles[static_cast<std::size_t>(n)], radial = force[3 * n],
                   around = force[3 * n + 1];
      const double components[3] = {radial * std::cos(angle) - around * std::sin(angle),
                                    radial * std::sin(angle) + around * std::cos(angle), force[3 * n + 2]};
      for (int c = 0; c < 3; ++c)
        if (std::fabs(components[c]) > 1e-14 * scale)
          fmt::print(out, "{}, {}, {}\n", n + 1, c + 1, number(components[c], scale));
    }
    fmt::print(out, "*NODE PRINT, NSET=ALL\nU\n*NODE FILE\nU\n*END STEP\n");
  }
}

} // namespace strainwave
