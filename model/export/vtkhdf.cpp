#include "strainwave/model/export/vtkhdf.hpp"

#include "strainwave/common/files/hdf5.hpp"

#include <cassert>

namespace strainwave {

namespace {

void put_arrays(const hdf5::Group& group, const std::vector<GridArray>& arrays) {
  for (const GridArray& array : arrays)
    std::visit(
        [&](const auto& values) {
          const auto components = static_cast<std::size_t>(array.components);
          const hdf5::Shape shape = components == 1 ? hdf5::Shape{values.size()}
                                                    : hdf5::Shape{values.size() / components, components};
          group.put(array.name, values, shape).set_text("units", array.unit);
        },
        array.values);
}

void put_grid(const hdf5::Group& file, const UnstructuredGrid& grid) {
  const hdf5::Group group = file.make_group("VTKHDF");
  group.set_numbers("Version", std::vector<std::int64_t>{1, 0});
  group.set_ascii("Type", "UnstructuredGrid"); // which the reader compares bit by bit
  const auto number = [&](const char* name, std::size_t count) {
    group.put(name, std::vector{static_cast<std::int64_t>(count)});
  };
  number("NumberOfPoints", grid.points.size() / 3);
  number("NumberOfCells", grid.types.size());
  number("NumberOfConnectivityIds", grid.connectivity.size());
  group.put("Points", grid.points, {grid.points.size() / 3, 3});
  group.put("Connectivity", grid.connectivity);
  group.put("Offsets", grid.offsets);
  group.put("Types", grid.types);
  put_arrays(group.make_group("PointData"), grid.point_data);
  put_arrays(group.make_group("CellData"), grid.cell_data);
}

} // namespace

void write_vtkhdf(const UnstructuredGrid& grid, const std::string& config,
                  const std::filesystem::path& path) {
  assert(grid.offsets.size() == grid.types.size() + 1);
  hdf5::write_file(path, {"strainwave fields", 1}, [&](const hdf5::Group& file) {
    put_grid(file, grid);
    file.put_text("config", config);
  });
}

} // namespace strainwave
