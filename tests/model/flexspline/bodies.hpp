#pragma once
// Bodies for tests: a plain tube sector, and a coarse cup with few broad teeth.

#include "strainwave/model/flexspline/mesh.hpp"
#include "strainwave/model/flexspline/responses.hpp"

#include <map>
#include <numbers>
#include <tuple>

namespace strainwave::testing_bodies {

struct Tube {
  double inner = 0.0, outer = 0.0, bottom = 0.0, top = 0.0; ///< mm
  int sectors = 4, around = 1, layers = 1, rows = 1;        ///< element counts of one sector
};

/// One sector of a smooth tube, nothing fixed; element order as in sector_mesh.
inline SectorMesh tube_mesh(const Tube& tube) {
  SectorMesh mesh;
  mesh.sectors = tube.sectors;
  const double pitch = 2.0 * std::numbers::pi / tube.sectors;
  std::map<std::tuple<int, int, int>, int> index_of;
  const int steps[20][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
                            {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
                            {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
  for (int i = 0; i < 2 * tube.layers; i += 2)
    for (int j = 0; j < 2 * tube.rows; j += 2)
      for (int k = 0; k < 2 * tube.around; k += 2) {
        std::array<int, 20> element{};
        for (std::size_t a = 0; a < 20; ++a) {
          const int ii = i + steps[a][0], kk = k + steps[a][1], jj = j + steps[a][2];
          const auto [place, is_new] =
              index_of.try_emplace({ii, jj, kk}, static_cast<int>(mesh.nodes.size()));
          if (is_new)
            mesh.nodes.push_back({tube.inner + (tube.outer - tube.inner) * ii / (2.0 * tube.layers),
                                  pitch * (kk - tube.around) / (2.0 * tube.around),
                                  tube.bottom + (tube.top - tube.bottom) * jj / (2.0 * tube.rows)});
          element[a] = place->second;
        }
        if (i == 0)
          mesh.inner_wall.push_back({static_cast<int>(mesh.elements.size()), 6});
        mesh.elements.push_back(element);
        mesh.region.push_back(Region::wall);
      }
  for (const auto& [place, index] : index_of) {
    const auto [i, j, k] = place;
    if (k != 0)
      continue;
    mesh.left.push_back(index);
    mesh.right.push_back(index_of.at({i, j, 2 * tube.around}));
  }
  mesh.number();
  return mesh;
}

/// The seed cup's measures with 20 broad teeth and a coarse mesh: small enough for full solutions.
inline ResponseRequest broad_toothed_cup() {
  const Gear seed = seed_gear();
  ResponseRequest request;
  request.flexspline = seed.flexspline;
  request.material = seed.material;
  request.flexspline.teeth = 20;
  request.flexspline.module_mm = 1.4;
  request.flexspline.profile_shift = 1.5;
  request.mesh = {.per_pitch = 3,
                  .along_face = 2,
                  .along_wall = 4,
                  .diaphragm = 3,
                  .tooth_height = 1,
                  .through_thickness = 1};
  request.flank_heights = 3;
  request.face_slices = 2;
  request.estimate = false;
  return request;
}

/// The seed cup on its default mesh, without the estimate.
inline ResponseRequest seed_cup() {
  const Gear seed = seed_gear();
  ResponseRequest request;
  request.flexspline = seed.flexspline;
  request.material = seed.material;
  request.mesh = seed.mesh;
  request.estimate = false;
  return request;
}

} // namespace strainwave::testing_bodies
