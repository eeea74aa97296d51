#pragma once
// VTKHDF, version 1.0, type UnstructuredGrid: the HDF5 layout that ParaView 5.10 and VTK 9.1 (vtkHDFReader)
// open. One piece, so the Number… datasets have one entry:
//
//   /VTKHDF                 attributes Version = {1, 0}, Type = "UnstructuredGrid"
//     NumberOfPoints, NumberOfCells, NumberOfConnectivityIds   int64[1]
//     Points float64[n][3]   Connectivity int64[]   Offsets int64[cells + 1]   Types uint8[cells]
//     PointData/NAME, CellData/NAME   [n] or [n][3]; the unit in the attribute "units"
//   /config                 text: the gear file it was made from
//
// Source: VTK User's Guide, "VTKHDF file format" (docs.vtk.org).

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace strainwave {

struct GridArray {
  std::string name, unit;
  int components = 1; ///< 1, or 3: Cartesian x, y, z of one point after the other
  std::variant<std::vector<double>, std::vector<std::int32_t>> values;
};

struct UnstructuredGrid {
  std::vector<double> points; ///< mm; x, y, z of one point after the other
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets; ///< of each cell in `connectivity`, and its end
  std::vector<std::uint8_t> types;   ///< VTK's cell types
  std::vector<GridArray> point_data, cell_data;
};

/// Throws std::system_error with the cause; an older file of that name stays when it does.
void write_vtkhdf(const UnstructuredGrid& grid, const std::string& config, const std::filesystem::path& path);

} // namespace strainwave
