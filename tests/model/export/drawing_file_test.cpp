// Profiles as files: DXF groups, CSV columns.

#include "strainwave/model/export/profile_csv.hpp"
#include "strainwave/model/export/profile_dxf.hpp"

#include "tests/model/export/folder.hpp"

#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace strainwave {
namespace {

std::vector<std::pair<int, std::string>> groups_of(const std::string& dxf) {
  std::vector<std::pair<int, std::string>> groups;
  std::istringstream in(dxf);
  std::string code, value;
  while (std::getline(in, code) && std::getline(in, value))
    groups.emplace_back(std::stoi(code), value);
  return groups;
}

TEST(Dxf, every_outline_is_a_closed_polyline_on_a_declared_layer) {
  const auto outlines = profile_outlines(seed_gear());
  ASSERT_TRUE(outlines.ok());
  const auto groups = groups_of(profile_dxf(*outlines));
  std::map<std::string, int> layers;
  std::vector<std::size_t> vertices;
  std::string entity;
  for (const auto& [code, value] : groups) {
    if (code == 0) {
      entity = value;
      if (entity == "POLYLINE")
        vertices.push_back(0);
      if (entity == "VERTEX")
        ++vertices.back();
    } else if (entity == "LAYER" && code == 2) {
      layers[value] = 0;
    } else if (entity == "POLYLINE" && code == 70) {
      EXPECT_EQ(value, "1"); // closed
    } else if (entity == "POLYLINE" && code == 8) {
      ASSERT_TRUE(layers.contains(value)) << value;
      ++layers[value];
    }
  }
  ASSERT_EQ(vertices.size(), outlines->size());
  for (std::size_t k = 0; k < vertices.size(); ++k)
    EXPECT_EQ(vertices[k], (*outlines)[k].points.size());
  for (const auto& [layer, count] : layers)
    EXPECT_GT(count, 0) << layer;
  EXPECT_EQ(groups.back().second, "EOF");
}

TEST(Dxf, says_that_it_is_in_millimetres) {
  const auto groups = groups_of(profile_dxf(profile_outlines(seed_gear()).value()));
  for (std::size_t k = 0; k + 1 < groups.size(); ++k)
    if (groups[k].second == "$INSUNITS") {
      EXPECT_EQ(groups[k + 1], std::pair(70, std::string("4")));
      return;
    }
  FAIL() << "no $INSUNITS";
}

TEST(Dxf, ezdxf_finds_no_fault_when_it_is_there) {
  if (std::system("/usr/bin/python3 -c 'import ezdxf' > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "python3-ezdxf is not installed";
  const testing_export::TemporaryFolder folder;
  std::ofstream(folder / "teeth.dxf") << profile_dxf(profile_outlines(seed_gear()).value());
  std::ofstream(folder / "read.py")
      << "import ezdxf, sys\nd = ezdxf.readfile(sys.argv[1]); a = d.audit()\n"
         "m = d.modelspace()\n"
         "print(len(a.errors), len(a.fixes), d.units, all(e.is_closed for e in m))\n";
  const std::string command = "/usr/bin/python3 '" + (folder / "read.py").string() + "' '" +
                              (folder / "teeth.dxf").string() + "' > '" + (folder / "out.txt").string() +
                              "' 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(testing_export::text_of(folder / "out.txt"), "0 0 4 True\n");
}

TEST(Csv, header_carries_units_and_every_line_its_nine_fields) {
  const auto outlines = profile_outlines(seed_gear());
  ASSERT_TRUE(outlines.ok());
  std::istringstream in(profile_csv(*outlines));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "outline,tooth,phi_deg,part,flank_coordinate,radius_mm,x_mm,y_mm,removal_um");
  std::size_t lines = 0, points = 0;
  while (std::getline(in, line)) {
    ++lines;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 8) << line;
  }
  for (const Outline& outline : *outlines)
    points += outline.points.size();
  EXPECT_EQ(lines, points);
}

} // namespace
} // namespace strainwave
