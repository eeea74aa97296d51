// Structure of the VTKHDF file, read back with HDF5, and VTK's numbering of a quadratic hexahedron.

#include "strainwave/common/files/hdf5.hpp"
#include "strainwave/model/export/cup_grid.hpp"

#include "tests/model/export/folder.hpp"
#include "tests/model/flexspline/bodies.hpp"

#include <array>
#include <cmath>
#include <system_error>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <hdf5_hl.h>

namespace strainwave {
namespace {

SectorMesh coarse_mesh() {
  const ResponseRequest request = testing_bodies::broad_toothed_cup();
  return sector_mesh(request.flexspline, request.mesh).value();
}

Eigen::Vector3d point(const UnstructuredGrid& grid, std::size_t cell, std::size_t node) {
  const auto at =
      3 * static_cast<std::size_t>(grid.connectivity[static_cast<std::size_t>(grid.offsets[cell]) + node]);
  return {grid.points[at], grid.points[at + 1], grid.points[at + 2]};
}

TEST(RingGrid, mid_side_nodes_stand_on_the_edges_that_vtk_gives_them) {
  // vtkQuadraticHexahedron's edges: corner, corner, mid-side node (VTK User's Guide, figure of cell type 25).
  constexpr std::size_t edges[12][3] = {{0, 1, 8},  {1, 2, 9},  {3, 2, 10}, {0, 3, 11},
                                        {4, 5, 12}, {5, 6, 13}, {7, 6, 14}, {4, 7, 15},
                                        {0, 4, 16}, {1, 5, 17}, {2, 6, 18}, {3, 7, 19}};
  const UnstructuredGrid grid = ring_grid(coarse_mesh());
  for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
    ASSERT_EQ(grid.types[cell], 25);
    ASSERT_EQ(grid.offsets[cell + 1] - grid.offsets[cell], 20);
    for (const auto& edge : edges) {
      const Eigen::Vector3d a = point(grid, cell, edge[0]), b = point(grid, cell, edge[1]);
      // Curved edges of this coarse ring bulge by up to a quarter of the half pitch angle.
      EXPECT_LT((point(grid, cell, edge[2]) - 0.5 * (a + b)).norm(), 0.2 * (b - a).norm())
          << "cell " << cell << ", node " << edge[2];
    }
  }
}

TEST(RingGrid, cells_are_right_handed_in_vtks_order) {
  // VTK's hexahedron: bottom 0 1 2 3, top 4 5 6 7 above it; edges leaving each corner, right-handed.
  constexpr std::size_t leaving[8][4] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                         {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};
  const UnstructuredGrid grid = ring_grid(coarse_mesh());
  for (std::size_t cell = 0; cell < grid.types.size(); ++cell)
    for (const auto& corner : leaving) {
      const Eigen::Vector3d o = point(grid, cell, corner[0]);
      const Eigen::Vector3d a = point(grid, cell, corner[1]) - o, b = point(grid, cell, corner[2]) - o,
                            c = point(grid, cell, corner[3]) - o;
      EXPECT_GT(a.dot(b.cross(c)), 0.0) << "cell " << cell << ", corner " << corner[0];
    }
}

TEST(RingGrid, every_node_is_used_and_the_ring_is_closed) {
  const SectorMesh mesh = coarse_mesh();
  const UnstructuredGrid grid = ring_grid(mesh);
  EXPECT_EQ(grid.types.size(), mesh.ring_elements());
  std::vector<int> used(mesh.ring_nodes(), 0);
  for (const std::int64_t node : grid.connectivity)
    ++used[static_cast<std::size_t>(node)];
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
}

class VtkhdfFile : public testing::Test {
protected:
  VtkhdfFile() {
    grid = ring_grid(coarse_mesh());
    grid.point_data.push_back({"push", "mm", 3, std::vector<double>(grid.points.size(), 0.25)});
    write_vtkhdf(grid, "name = \"x\"\n", folder / "cup.vtkhdf");
    file = H5Fopen((folder / "cup.vtkhdf").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  }
  ~VtkhdfFile() override { H5Fclose(file); }
  std::vector<hsize_t> shape(const char* name) const {
    int rank = 0;
    H5LTget_dataset_ndims(file, name, &rank);
    std::vector<hsize_t> size(static_cast<std::size_t>(rank));
    H5LTget_dataset_info(file, name, size.data(), nullptr, nullptr);
    return size;
  }
  std::pair<H5T_class_t, std::size_t> type(const char* name) const {
    std::vector<hsize_t> size(4);
    H5T_class_t kind{};
    std::size_t bytes = 0;
    H5LTget_dataset_info(file, name, size.data(), &kind, &bytes);
    return {kind, bytes};
  }
  std::int64_t number(const char* name) const {
    std::int64_t value = -1;
    H5LTread_dataset(file, name, H5T_NATIVE_INT64, &value);
    return value;
  }

  testing_export::TemporaryFolder folder;
  UnstructuredGrid grid;
  hid_t file = -1;
};

TEST_F(VtkhdfFile, names_its_version_and_type_as_the_reader_compares_them) {
  long long version[2] = {};
  ASSERT_GE(H5LTget_attribute_long_long(file, "/VTKHDF", "Version", version), 0);
  EXPECT_EQ(version[0], 1);
  EXPECT_EQ(version[1], 0);
  const hid_t attribute = H5Aopen_by_name(file, "/VTKHDF", "Type", H5P_DEFAULT, H5P_DEFAULT);
  const hid_t kind = H5Aget_type(attribute);
  EXPECT_GT(H5Tis_variable_str(kind), -1);
  EXPECT_EQ(H5Tis_variable_str(kind), 0);
  std::string text(H5Tget_size(kind), ' ');
  H5Aread(attribute, kind, text.data());
  EXPECT_EQ(text, "UnstructuredGrid");
  H5Tclose(kind);
  H5Aclose(attribute);
}

TEST_F(VtkhdfFile, sizes_and_types_fit_together) {
  const hsize_t points = grid.points.size() / 3, cells = grid.types.size();
  EXPECT_EQ(number("/VTKHDF/NumberOfPoints"), static_cast<std::int64_t>(points));
  EXPECT_EQ(number("/VTKHDF/NumberOfCells"), static_cast<std::int64_t>(cells));
  EXPECT_EQ(number("/VTKHDF/NumberOfConnectivityIds"), static_cast<std::int64_t>(20 * cells));
  EXPECT_EQ(shape("/VTKHDF/Points"), (std::vector<hsize_t>{points, 3}));
  EXPECT_EQ(shape("/VTKHDF/Connectivity"), (std::vector<hsize_t>{20 * cells}));
  EXPECT_EQ(shape("/VTKHDF/Offsets"), (std::vector<hsize_t>{cells + 1}));
  EXPECT_EQ(shape("/VTKHDF/Types"), (std::vector<hsize_t>{cells}));
  EXPECT_EQ(type("/VTKHDF/Types"), std::pair(H5T_INTEGER, std::size_t{1}));
  EXPECT_EQ(type("/VTKHDF/Connectivity"), std::pair(H5T_INTEGER, std::size_t{8}));
  EXPECT_EQ(type("/VTKHDF/Points"), std::pair(H5T_FLOAT, std::size_t{8}));
}

TEST_F(VtkhdfFile, point_and_cell_data_have_their_units) {
  EXPECT_EQ(shape("/VTKHDF/PointData/push"), (std::vector<hsize_t>{grid.points.size() / 3, 3}));
  EXPECT_EQ(shape("/VTKHDF/CellData/region"), (std::vector<hsize_t>{grid.types.size()}));
  EXPECT_EQ(hdf5::File(folder / "cup.vtkhdf").dataset("VTKHDF/PointData/push").text("units"), "mm");
}

TEST(Vtkhdf, folder_that_is_not_there_is_named_with_the_cause) {
  try {
    write_vtkhdf(ring_grid(coarse_mesh()), "", "/nonexistent/cup.vtkhdf");
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ENOENT);
    EXPECT_NE(std::string(error.what()).find("/nonexistent/cup.vtkhdf"), std::string::npos);
  }
}

TEST(Vtkhdf, vtk_itself_reads_it_when_it_is_there) {
  // Package python3-vtk9 belongs to Debian's own Python.
  if (std::system("/usr/bin/python3 -c 'import vtk' > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "python3-vtk9 is not installed";
  const testing_export::TemporaryFolder folder;
  const UnstructuredGrid grid = ring_grid(coarse_mesh());
  write_vtkhdf(grid, "", folder / "cup.vtkhdf");
  std::ofstream(folder / "read.py")
      << "import vtk, sys\n"
         "r = vtk.vtkHDFReader(); r.SetFileName(sys.argv[1]); r.Update()\n"
         "g = r.GetOutput()\n"
         "print(g.GetNumberOfPoints(), g.GetNumberOfCells(), g.GetCell(0).GetClassName())\n";
  const std::string command = "/usr/bin/python3 '" + (folder / "read.py").string() + "' '" +
                              (folder / "cup.vtkhdf").string() + "' > '" + (folder / "out.txt").string() +
                              "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(testing_export::text_of(folder / "out.txt"), std::to_string(grid.points.size() / 3) + " " +
                                                             std::to_string(grid.types.size()) +
                                                             " vtkQuadraticHexahedron\n");
}

} // namespace
} // namespace strainwave
