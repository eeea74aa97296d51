#include "strainwave/model/flexspline/mesh.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/flexspline/element.hpp"
#include "strainwave/model/flexspline/tooth_outline.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include <fmt/format.h>

namespace strainwave {

namespace {

using units::pi;
constexpr double most_strips = 200.0; ///< elements along the front clearance, as many as along a face at most

Failure contradiction(std::string message) {
  return {Status::contradiction, std::move(message)};
}

/// The meridian lattice and the angular lattice, in half elements, and where their places lie.
class SectorLattice {
public:
  SectorLattice(const Flexspline& flexspline, const Mesh& counts, const SectorShape& shape, int sectors)
      : f(flexspline), teeth(shape.teeth), layers(counts.through_thickness), radial(counts.diaphragm) {
    const double inner = f.neutral_radius_mm - f.rim_thickness_mm / 2.0;
    const double rim = teeth ? f.root_radius_mm - inner : f.wall_thickness_mm;
    const double rear = f.cup_length_mm - f.front_clearance_mm - f.face_width_mm;
    const double bottom = f.diaphragm_thickness_mm / 2.0;
    const double step = std::fabs(rim - f.wall_thickness_mm);
    const bool has_step = step > 1e-9 * rim;
    inner_radius = inner;
    for (int j = 0; j <= 2 * layers; ++j)
      add_row(-bottom + 2.0 * bottom * j / (2 * layers), f.wall_thickness_mm);
    add_rows(counts.along_wall, has_step ? rear - step : rear, f.wall_thickness_mm, Region::wall);
    if (has_step)
      add_rows(1, rear, rim, Region::wall);
    face_begin = static_cast<int>(z.size()) - 1;
    add_rows(counts.along_face, rear + f.face_width_mm, rim, Region::rim);
    face_end = static_cast<int>(z.size()) - 1;
    if (f.front_clearance_mm > 0.0) {
      const double row = f.face_width_mm / counts.along_face;
      const int strips =
          static_cast<int>(std::clamp(std::round(f.front_clearance_mm / row), 1.0, most_strips));
      add_rows(strips, f.cup_length_mm, rim, Region::front);
    }
    heights = teeth ? counts.tooth_height : 0;
    gap = teeth ? std::max(1, counts.per_pitch / 4) : 0;
    const double half_pitch = pi / sectors;
    const double foot = teeth ? tooth_half_angle(f, f.root_radius_mm) : half_pitch;
    for (int k = 0; k <= 2 * counts.per_pitch; ++k) {
      // Built from the middle outwards: mirror images then have the same bits.
      const int from_middle = k - counts.per_pitch, distance = std::abs(from_middle);
      const int half_tooth = counts.per_pitch - 2 * gap;
      const double at = distance <= half_tooth
                            ? foot * distance / half_tooth
                            : foot + (half_pitch - foot) * (distance - half_tooth) / (2.0 * gap);
      angle.push_back(from_middle < 0 ? -at : at);
    }
  }

  CylinderPoint place(int i, int j, int k) const {
    const int wall = 2 * radial, outer = wall + 2 * layers;
    const auto row = static_cast<std::size_t>(j), column = static_cast<std::size_t>(k);
    if (i <= wall)
      return {f.boss_radius_mm + (inner_radius - f.boss_radius_mm) * i / wall, angle[column], z[row]};
    if (i <= outer)
      return {inner_radius + thickness[row] * (i - wall) / (2.0 * layers), angle[column], z[row]};
    const double radius =
        f.root_radius_mm + (f.tip_radius_mm - f.root_radius_mm) * (i - outer) / (2.0 * heights);
    const double narrowed = tooth_half_angle(f, radius) / tooth_half_angle(f, f.root_radius_mm);
    return {radius, angle[column] * narrowed, z[row]};
  }

  const Flexspline& f;
  bool teeth;
  int layers, radial, heights = 0, gap = 0, face_begin = 0, face_end = 0;
  double inner_radius = 0.0;
  std::vector<double> z, thickness, angle;
  std::vector<Region> row_region; ///< of the row of elements that ends at this z; one entry for two half rows

private:
  void add_row(double at, double wall) {
    z.push_back(at);
    thickness.push_back(wall);
  }
  void add_rows(int rows, double end, double wall, Region name) {
    const double begin = z.back(), wall_begin = thickness.back();
    for (int j = 1; j <= 2 * rows; ++j) {
      const double t = j / (2.0 * rows);
      add_row(j == 2 * rows ? end : begin + (end - begin) * t, wall_begin + (wall - wall_begin) * t);
    }
    row_region.insert(row_region.end(), static_cast<std::size_t>(rows), name);
  }
};

/// Local half-element steps (ξ, η, ζ) of the 20 nodes.
constexpr int node_steps[20][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2},
                                   {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}, {2, 1, 0},
                                   {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2},
                                   {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};

Outcome<int> checked_sectors(const Flexspline& f, const Mesh& m, const SectorShape& shape) {
  const int sectors = shape.sectors > 0 ? shape.sectors : f.teeth;
  if (sectors < 3)
    return contradiction(fmt::format("a ring needs at least 3 sectors, not {}", sectors));
  if (shape.teeth && sectors != f.teeth)
    return contradiction(fmt::format("a cup with {} teeth has as many sectors, not {}", f.teeth, sectors));
  if (std::min({m.per_pitch, m.along_face, m.along_wall, m.diaphragm, m.tooth_height, m.through_thickness}) <
      1)
    return contradiction("every element count of the mesh must be at least 1");
  if (shape.teeth && m.per_pitch < 3)
    return contradiction(
        fmt::format("mesh.per_pitch = {} cannot show a tooth and its gaps: at least 3", m.per_pitch));
  const double inner = f.neutral_radius_mm - f.rim_thickness_mm / 2.0;
  const double rear = f.cup_length_mm - f.front_clearance_mm - f.face_width_mm;
  const double rim = shape.teeth ? f.root_radius_mm - inner : f.wall_thickness_mm;
  if (f.boss_radius_mm <= 0.0 || inner <= f.boss_radius_mm)
    return contradiction(fmt::format("the boss ({} mm) must be smaller than the wall's inner radius ({} mm)",
                                     f.boss_radius_mm, inner));
  if (f.wall_thickness_mm <= 0.0 || f.diaphragm_thickness_mm <= 0.0 || rim <= 0.0)
    return contradiction(
        fmt::format("wall ({} mm), diaphragm ({} mm) and rim ({} mm) need a positive thickness",
                    f.wall_thickness_mm, f.diaphragm_thickness_mm, rim));
  if (f.face_width_mm <= 0.0 || f.front_clearance_mm < 0.0 ||
      rear - std::fabs(rim - f.wall_thickness_mm) <= f.diaphragm_thickness_mm / 2.0)
    return contradiction(
        fmt::format("a face of {} mm and a front clearance of {} mm leave no wall in a cup of {} mm",
                    f.face_width_mm, f.front_clearance_mm, f.cup_length_mm));
  if (!shape.teeth)
    return sectors;
  if (f.tip_radius_mm <= f.root_radius_mm)
    return contradiction(
        fmt::format("the flexspline's tip radius ({} mm) must exceed its root radius ({} mm)",
                    f.tip_radius_mm, f.root_radius_mm));
  const double tip = tooth_half_angle(f, f.tip_radius_mm), foot = tooth_half_angle(f, f.root_radius_mm);
  if (!(tip > 0.0))
    return contradiction(fmt::format("the flexspline's tooth is pointed before its tip circle of {} mm (tip "
                                     "thickness {:.4f} mm)",
                                     f.tip_radius_mm, 2.0 * tip * f.tip_radius_mm));
  if (!(foot < pi / sectors))
    return contradiction(
        fmt::format("the flexspline's teeth overlap at the root circle of {} mm (tooth {:.4f} mm, "
                    "pitch {:.4f} mm)",
                    f.root_radius_mm, 2.0 * foot * f.root_radius_mm, 2.0 * pi / sectors * f.root_radius_mm));
  return sectors;
}

class Builder {
public:
  Builder(const SectorLattice& lattice_in, int per_pitch_in, int sectors)
      : lattice(lattice_in), per_pitch(per_pitch_in) {
    mesh.sectors = sectors;
  }

  SectorMesh build() {
    const int wall = 2 * lattice.radial, outer = wall + 2 * lattice.layers, corner = 2 * lattice.layers;
    const int end = static_cast<int>(lattice.z.size()) - 1;
    for (int i = 0; i < wall; i += 2)
      for (int j = 0; j < corner; j += 2)
        sweep(i, j, 0, Region::diaphragm);
    for (int j = 0; j < end; j += 2)
      for (int i = wall; i < outer; i += 2)
        sweep(i, j, 0,
              j < corner ? Region::corner : lattice.row_region[static_cast<std::size_t>((j - corner) / 2)]);
    for (int j = lattice.face_begin; j < lattice.face_end; j += 2)
      for (int i = outer; i < outer + 2 * lattice.heights; i += 2)
        sweep(i, j, lattice.gap, Region::tooth);
    for (const auto& [place, index] : index_of) {
      const auto [i, j, k] = place;
      if (k == 0) {
        mesh.left.push_back(index);
        mesh.right.push_back(index_of.at({i, j, 2 * per_pitch}));
      }
      if (i == 0)
        mesh.boss.push_back(index);
    }
    std::sort(mesh.boss.begin(), mesh.boss.end());
    for (const int node : mesh.boss)
      for (int component = 0; component < 3; ++component)
        mesh.fixed.push_back(3 * node + component);
    mesh.number();
    return std::move(mesh);
  }

private:
  /// The elements over one meridian quadrilateral, all around but for `gap` elements at both ends.
  void sweep(int i, int j, int gap, Region name) {
    const int wall = 2 * lattice.radial, corner = 2 * lattice.layers;
    for (int k = 2 * gap; k < 2 * (per_pitch - gap); k += 2) {
      std::array<int, 20> element{};
      for (std::size_t a = 0; a < 20; ++a)
        element[a] = node_at(i + node_steps[a][0], j + node_steps[a][2], k + node_steps[a][1]);
      const int index = static_cast<int>(mesh.elements.size());
      mesh.elements.push_back(element);
      mesh.region.push_back(name);
      if (name == Region::tooth && k == 2 * (per_pitch - gap) - 2)
        mesh.drive_flank.push_back({index, 5});
      if (name == Region::tooth && k == 2 * gap)
        mesh.coast_flank.push_back({index, 3});
      if (i == wall && j >= corner)
        mesh.inner_wall.push_back({index, 6});
    }
  }

  int node_at(int i, int j, int k) {
    const auto [place, is_new] = index_of.try_emplace({i, j, k}, static_cast<int>(mesh.nodes.size()));
    if (is_new)
      mesh.nodes.push_back(lattice.place(i, j, k));
    return place->second;
  }

  const SectorLattice& lattice;
  int per_pitch;
  SectorMesh mesh;
  std::map<std::tuple<int, int, int>, int> index_of;
};

} // namespace

double SectorMesh::pitch_rad() const {
  return 2.0 * pi / sectors;
}

int SectorMesh::ring_node(int i, int sector) const {
  const auto at = static_cast<std::size_t>(i);
  if (ring_index[at] < 0)
    return ring_node(left_twin[at], sector + 1);
  const int wrapped = (sector % sectors + sectors) % sectors;
  return wrapped * owned() + ring_index[at];
}

double SectorMesh::angle(int i, int sector) const {
  return nodes[static_cast<std::size_t>(i)].angle + pitch_rad() * sector;
}

CartesianPoint SectorMesh::node(int i, int sector) const {
  const CylinderPoint& p = nodes[static_cast<std::size_t>(i)];
  const double phi = angle(i, sector);
  return {p.radius * std::cos(phi), p.radius * std::sin(phi), p.z};
}

void SectorMesh::number() {
  ring_index.assign(nodes.size(), 0);
  left_twin.assign(nodes.size(), -1);
  for (std::size_t b = 0; b < right.size(); ++b) {
    ring_index[static_cast<std::size_t>(right[b])] = -1;
    left_twin[static_cast<std::size_t>(right[b])] = left[b];
  }
  int next = 0;
  for (int& index : ring_index)
    if (index == 0)
      index = next++;
}

Outcome<SectorMesh> sector_mesh(const Flexspline& flexspline, const Mesh& counts, const SectorShape& shape) {
  const Outcome<int> sectors = checked_sectors(flexspline, counts, shape);
  if (!sectors)
    return sectors.failure();
  const SectorLattice lattice(flexspline, counts, shape, *sectors);
  SectorMesh mesh = Builder(lattice, counts.per_pitch, *sectors).build();
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const double volume = smallest_jacobian(element_points(mesh, static_cast<int>(e)));
    if (!(volume > 0.0))
      return contradiction(
          fmt::format("element {} of the flexspline's mesh is inverted (Jacobian {:.3g} mm³): the "
                      "geometry folds there, or its counts are too coarse for it",
                      e, volume));
  }
  return mesh;
}

MeshSize mesh_size(const Flexspline& f, const Mesh& m, bool teeth) {
  const double strips =
      std::clamp(std::round(f.front_clearance_mm * m.along_face / f.face_width_mm), 1.0, most_strips);
  const double layers = m.through_thickness;
  const double meridian =
      m.diaphragm + layers + m.along_wall + 1.0 + m.along_face + strips; // columns of `layers` elements
  const double on_teeth = teeth ? static_cast<double>(m.along_face) * m.tooth_height : 0.0;
  // 8 nodes a quadrilateral, shared: 3nL + 2n + 2L + 1 on a strip of n × L
  return {.elements = (meridian * layers + on_teeth) * m.per_pitch,
          .side_unknowns = 3.0 * (3.0 * meridian * layers + 2.0 * (meridian + layers) + 1.0)};
}

Mesh coarser(const Mesh& counts, bool teeth) {
  const auto half = [](int n, int least) { return std::max(least, (n + 1) / 2); };
  return {.per_pitch = half(counts.per_pitch, teeth ? 3 : 1),
          .along_face = half(counts.along_face, teeth ? 2 : 1), // one alone may not hold a tooth, element.hpp
          .along_wall = half(counts.along_wall, 1),
          .diaphragm = half(counts.diaphragm, 1),
          .tooth_height = half(counts.tooth_height, 1),
          .through_thickness = half(counts.through_thickness, 1)};
}

} // namespace strainwave
