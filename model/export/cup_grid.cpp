#include "strainwave/model/export/cup_grid.hpp"

#include <cmath>

namespace strainwave {

namespace {

/// Calls visit(node of the sector, sector, node of the ring) once for every node of the ring.
template <class Visit>
void each_ring_node(const SectorMesh& mesh, const Visit& visit) {
  for (int j = 0; j < mesh.sectors; ++j)
    for (int i = 0; i < static_cast<int>(mesh.nodes.size()); ++i)
      if (mesh.ring_index[static_cast<std::size_t>(i)] >= 0)
        visit(i, j, static_cast<std::size_t>(mesh.ring_node(i, j)));
}

int tooth_of(const SectorMesh& mesh, int sector) {
  return 2 * sector > mesh.sectors ? sector - mesh.sectors : sector;
}

} // namespace

UnstructuredGrid ring_grid(const SectorMesh& mesh) {
  UnstructuredGrid grid;
  grid.points.resize(3 * mesh.ring_nodes());
  std::vector<std::int32_t> node_tooth(mesh.ring_nodes());
  each_ring_node(mesh, [&](int i, int sector, std::size_t at) {
    const CartesianPoint p = mesh.node(i, sector);
    grid.points[3 * at] = p.x;
    grid.points[3 * at + 1] = p.y;
    grid.points[3 * at + 2] = p.z;
    node_tooth[at] = tooth_of(mesh, sector);
  });
  std::vector<std::int32_t> tooth, region, sector_of;
  grid.offsets.push_back(0);
  for (int sector = 0; sector < mesh.sectors; ++sector)
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      for (const int node : mesh.elements[e])
        grid.connectivity.push_back(mesh.ring_node(node, sector));
      grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
      grid.types.push_back(vtk_quadratic_hexahedron);
      tooth.push_back(tooth_of(mesh, sector));
      region.push_back(static_cast<std::int32_t>(mesh.region[e]));
      sector_of.push_back(sector);
    }
  grid.point_data.push_back({"tooth", "1", 1, std::move(node_tooth)});
  grid.cell_data.push_back({"tooth", "1", 1, std::move(tooth)});
  grid.cell_data.push_back({"region", "1", 1, std::move(region)});
  grid.cell_data.push_back({"sector", "1", 1, std::move(sector_of)});
  return grid;
}

std::vector<double> cartesian(const SectorMesh& mesh, const Eigen::Ref<const Eigen::VectorXd>& cylindrical) {
  std::vector<double> result(3 * mesh.ring_nodes());
  each_ring_node(mesh, [&](int i, int sector, std::size_t at) {
    const double phi = mesh.angle(i, sector);
    const Eigen::Vector3d v = cylindrical.segment<3>(3 * static_cast<Eigen::Index>(at));
    result[3 * at] = std::cos(phi) * v[0] - std::sin(phi) * v[1];
    result[3 * at + 1] = std::sin(phi) * v[0] + std::cos(phi) * v[1];
    result[3 * at + 2] = v[2];
  });
  return result;
}

} // namespace strainwave
