#pragma once
// The seed cup's unit responses by an independent program (CalculiX 2.20, C3D20R, 141 120 nodes), as
// UnitResponses: tests/reference/unit-responses.json. Teeth: two heights, circumferential only; wall: radial
// point loads only, so the components that the file does not have are zero.

#include "strainwave/model/flexspline/unit_responses.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

namespace strainwave::testing_support {

inline nlohmann::json reference(const std::string& name) {
  std::ifstream file(std::string(STRAINWAVE_TEST_REFERENCE) + "/" + name);
  return nlohmann::json::parse(file);
}

inline UnitResponses reference_cup() {
  const nlohmann::json json = reference("unit-responses.json");
  UnitResponses u;
  u.sectors = 140;
  u.flank_radius_mm = json["flank_radius_mm"].get<std::vector<double>>();
  u.flank_z_mm = {24.5};
  u.wall_offset = {0.0, 0.5};
  u.wall_z_mm = json["wall_z_mm"].get<std::vector<double>>();
  const int n = u.count();
  u.data.assign(140U * static_cast<std::size_t>(n * n), 0.0);
  const auto at = [&](int k, int a, int b) -> double& {
    k = ((k % 140) + 140) % 140;
    return u.data[static_cast<std::size_t>((k * n + a) * n + b)];
  };
  const auto& tt = json["tooth_from_tooth"];
  const auto& wt = json["wall_from_tooth"];
  const auto& ww = json["wall_from_wall"];
  for (int k = 0; k < 140; ++k) {
    for (int load = 0; load < 2; ++load) {
      for (int level = 0; level < 2; ++level) {
        at(k, u.flank(level, 0, 0), u.flank(load, 0, 0)) = tt[load][level][k].get<double>();
      }
      for (int station = 0; station < 2; ++station) {
        for (int row = 0; row < 3; ++row) {
          const double value = wt[load][station][row][k].get<double>();
          at(k, u.wall(station, row, 1), u.flank(load, 0, 0)) = value;
          at(-k, u.flank(load, 0, 0), u.wall(station, row, 1)) = value;
        }
      }
    }
    for (int load = 0; load < 6; ++load) {
      for (int station = 0; station < 2; ++station) {
        for (int row = 0; row < 3; ++row) {
          at(k, u.wall(station, row, 1), u.wall(load / 3, load % 3, 1)) =
              ww[load][station][row][k].get<double>();
        }
      }
    }
  }
  // Printed digits leave it reciprocal to 7e-7 only; the mean of both directions is exactly so.
  const std::vector<double> printed = u.data;
  const auto old = [&](int k, int a, int b) {
    return printed[static_cast<std::size_t>((((k % 140) + 140) % 140 * n + a) * n + b)];
  };
  for (int k = 0; k < 140; ++k) {
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b)
        at(k, a, b) = 0.5 * (old(k, a, b) + old(-k, b, a));
    }
  }
  return u;
}

} // namespace strainwave::testing_support
