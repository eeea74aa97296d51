#pragma once
// What CalculiX printed: the .dat file of a deck of model/flexspline/calculix.hpp.

#include <istream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace strainwave::testing_support {

/// Cartesian displacements of all nodes from the text of a .dat file, one vector (3·nodes) a step, in mm.
/// Throws std::runtime_error with the line when the text is no such file.
inline std::vector<std::vector<double>> read_calculix_displacements(std::istream& in, int nodes) {
  std::vector<std::vector<double>> steps;
  std::string line;
  while (std::getline(in, line)) {
    if (line.find("displacements") != std::string::npos) {
      steps.emplace_back(3 * static_cast<std::size_t>(nodes), 0.0);
      continue;
    }
    std::istringstream fields(line);
    long node = 0;
    double u[3] = {};
    if (steps.empty() || !(fields >> node))
      continue;
    if (!(fields >> u[0] >> u[1] >> u[2]) || node < 1 || node > nodes)
      throw std::runtime_error("not a CalculiX displacement line: " + line);
    for (std::size_t c = 0; c < 3; ++c)
      steps.back()[3 * static_cast<std::size_t>(node - 1) + c] = u[c];
  }
  return steps;
}

} // namespace strainwave::testing_support
