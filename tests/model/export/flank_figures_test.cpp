// Maps over flank and face: their rectangles hold the result's numbers, and gnuplot draws them for any number
// of heights and slices.

#include "strainwave/model/export/flank_figures.hpp"

#include "strainwave/model/forward/forward.hpp"
#include "tests/model/export/folder.hpp"

#include <sstream>

#include <gtest/gtest.h>

namespace strainwave {
namespace {

Gear whole_flank(int heights, int slices, GapModel gaps) {
  Gear gear = testing_export::coarse_seed();
  gear.contact.flank_points = heights;
  gear.contact.face_slices = slices;
  gear.contact.gaps = gaps;
  gear.contact.window_deg = {-21.0, 51.0};
  gear.circular_spline.profile_shift = 2.42; // free as assembled
  return gear;
}

/// x, y, x from, x to, y from, y to, value.
std::vector<std::vector<double>> boxes_of(const std::string& data, int block) {
  std::vector<std::vector<double>> boxes;
  std::istringstream in(data);
  int at = 0;
  int empty = 0;
  for (std::string line; std::getline(in, line);) {
    empty = line.empty() ? empty + 1 : 0;
    at += empty == 2 ? 1 : 0;
    if (line.empty() || line[0] == '#' || at != block)
      continue;
    std::istringstream fields(line);
    boxes.emplace_back();
    for (double value = 0.0; fields >> value;)
      boxes.back().push_back(value);
  }
  return boxes;
}

const Figure* find(const std::vector<Figure>& figures, const std::string& name) {
  for (const Figure& figure : figures) {
    if (figure.name == name)
      return &figure;
  }
  return nullptr;
}

TEST(FlankFigures, RectanglesOfTheForceMapAddUpToTheMeshingForces) {
  const Gear gear = whole_flank(3, 4, GapModel::assembled);
  ForwardModel model({.disk_cache = false});
  const ForwardResult result = model.analyze(gear);
  ASSERT_EQ(result.status, Status::ok) << result.message;
  const std::vector<Figure> figures = flank_figures(result, gear);
  const Figure* map = find(figures, "force-map");
  ASSERT_NE(map, nullptr);
  for (int k = 0; k < 2; ++k) { // 1 and 7 N·m, the smaller one on top
    double drawn = 0.0;
    for (const auto& box : boxes_of(map->data, k)) {
      ASSERT_EQ(box.size(), 7u);
      EXPECT_GE(box[4], 21.5 - 1e-9);
      EXPECT_LE(box[5], 27.5 + 1e-9);
      drawn += box[6] * (box[5] - box[4]);
    }
    double forces = 0.0;
    for (const double force : result.load[static_cast<std::size_t>(k)].force_n)
      forces += force;
    EXPECT_NEAR(drawn, forces, 1e-7 * forces);
  }
}

TEST(FlankFigures, OnePointAToothHasNoMaps) {
  Gear gear = testing_export::coarse_seed();
  ForwardModel model({.disk_cache = false});
  EXPECT_TRUE(flank_figures(model.analyze(gear), gear).empty());
  gear.contact.gaps = GapModel::assembled; // but its assembled backlash varies over the face
  const auto figures = flank_figures(model.analyze(gear), gear);
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].name, "backlash-map");
}

TEST(FlankFigures, GnuplotDrawsThemForOneSliceAndForOneHeight) {
  if (std::system("command -v gnuplot > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "gnuplot (package gnuplot-nox) is not installed";
  ForwardModel model({.disk_cache = false});
  for (const auto& [heights, slices] : {std::pair{3, 4}, {3, 1}, {1, 3}}) {
    const Gear gear = whole_flank(heights, slices, GapModel::assembled);
    const auto figures = flank_figures(model.analyze(gear), gear);
    EXPECT_EQ(figures.size(), 5u);
    const testing_export::TemporaryFolder folder;
    const Drawn drawn = draw(figures, folder / "plots");
    EXPECT_TRUE(drawn.complete) << drawn.note;
    for (const Figure& figure : figures) {
      const std::string svg = testing_export::text_of(folder / "plots" / (figure.name + ".svg"));
      EXPECT_NE(svg.find("</svg>"), std::string::npos) << figure.name;
      const char* unit = figure.name == "force-map"                                  ? "N/mm"
                         : figure.name == "gap-map" || figure.name == "backlash-map" ? "µm"
                                                                                     : "MPa";
      EXPECT_NE(svg.find(unit), std::string::npos) << figure.name;
      EXPECT_GT(svg.size(), 8000u) << figure.name; // rectangles, not an empty frame
    }
  }
}

} // namespace
} // namespace strainwave
