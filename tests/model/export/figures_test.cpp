// Figures: their data, and pictures that are not empty.

#include "strainwave/model/export/figures.hpp"

#include "strainwave/model/forward/forward.hpp"
#include "tests/model/export/folder.hpp"

#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace strainwave {
namespace {

std::vector<Figure> all_figures(const Gear& gear, const ForwardResult& result, ForwardModel& model) {
  std::vector<Figure> figures = backlash_figures(result);
  for (Figure& figure : load_figures(result))
    figures.push_back(std::move(figure));
  Gear swept = gear;
  swept.load.torque_nm.clear();
  swept.load.rotation_rad = sweep_rotations_rad(result, 10);
  figures.push_back(torque_rotation_figure(result, model.analyze(swept)));
  figures.push_back(assembled_shape_figure(model.contact_states(gear).value().states.front()));
  return figures;
}

/// Lines of numbers of each block, blocks apart by empty lines.
std::vector<std::vector<std::vector<double>>> blocks_of(const std::string& data) {
  std::vector<std::vector<std::vector<double>>> blocks(1);
  std::istringstream in(data);
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) {
      if (!blocks.back().empty())
        blocks.emplace_back();
    } else if (line[0] != '#') {
      std::istringstream fields(line);
      blocks.back().emplace_back();
      for (std::string field; fields >> field;)
        blocks.back().back().push_back(std::stod(field));
    }
  }
  return blocks;
}

TEST(Figures, data_are_the_numbers_of_the_result) {
  Gear gear = testing_export::coarse_seed();
  gear.load.direction = Direction::both;
  ForwardModel model({.disk_cache = false});
  const ForwardResult result = model.analyze(gear);
  ASSERT_EQ(result.status, Status::ok) << result.message;
  ASSERT_EQ(result.load.size(), 4u);
  const std::vector<Figure> figures = load_figures(result);
  ASSERT_EQ(figures.size(), 3u);
  const auto blocks = blocks_of(figures[0].data);
  ASSERT_EQ(blocks.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    ASSERT_EQ(blocks[k].size(), result.load[k].tooth.size());
    for (std::size_t i = 0; i < blocks[k].size(); ++i) {
      EXPECT_EQ(blocks[k][i][0], result.load[k].tooth[i]);
      EXPECT_NEAR(blocks[k][i][2], result.load[k].force_n[i], 1e-8 * result.load[k].peak_force_n);
    }
  }
}

TEST(Figures, gnuplot_draws_every_one_of_them) {
  if (std::system("command -v gnuplot > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "gnuplot (package gnuplot-nox) is not installed";
  const Gear gear = testing_export::coarse_seed();
  ForwardModel model({.disk_cache = false});
  const ForwardResult result = model.analyze(gear);
  const std::vector<Figure> figures = all_figures(gear, result, model);
  EXPECT_EQ(figures.size(), 6u);
  const testing_export::TemporaryFolder folder;
  const Drawn drawn = draw(figures, folder / "plots");
  EXPECT_TRUE(drawn.complete) << drawn.note;
  for (const Figure& figure : figures) {
    const std::string svg = testing_export::text_of(folder / "plots" / (figure.name + ".svg"));
    EXPECT_NE(svg.find("</svg>"), std::string::npos) << figure.name;
    EXPECT_NE(svg.find("rgb(  0, 114, 178)"), std::string::npos) << figure.name; // the first curve
    EXPECT_NE(svg.find("<path"), std::string::npos) << figure.name;
  }
}

TEST(Figures, no_load_and_no_assembly_leave_only_the_backlash) {
  ForwardModel model({.disk_cache = false});
  const ForwardResult result = model.analyze(testing_export::coarse_seed(), Want::backlash);
  EXPECT_EQ(backlash_figures(result).size(), 1u);
  EXPECT_TRUE(load_figures(result).empty());
  EXPECT_TRUE(sweep_rotations_rad(result).empty());
}

/// PATH for the time of a test.
class Path {
public:
  explicit Path(const char* value) : old(std::getenv("PATH")) { setenv("PATH", value, 1); }
  ~Path() { setenv("PATH", old.c_str(), 1); }

private:
  std::string old;
};

TEST(Figures, without_gnuplot_the_data_are_written_and_a_sentence_says_why_there_are_no_pictures) {
  const testing_export::TemporaryFolder folder;
  const Path nowhere("/nonexistent");
  const Drawn drawn = draw({{.name = "a", .data = "1 2\n", .drawing = "plot 'a.dat'\n"}}, folder / "plots");
  EXPECT_FALSE(drawn.complete);
  EXPECT_NE(drawn.note.find("gnuplot-nox"), std::string::npos) << drawn.note;
  EXPECT_EQ(testing_export::text_of(folder / "plots" / "a.dat"), "1 2\n");
}

TEST(Figures, folder_under_a_file_is_an_error_with_the_cause) {
  const testing_export::TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(draw({}, folder / "file" / "plots"), std::system_error);
}

TEST(Figures, palette_repeats_after_its_six_colours) {
  EXPECT_EQ(figure_colour(0), figure_colour(6));
  EXPECT_NE(figure_colour(0), figure_colour(1));
}

} // namespace
} // namespace strainwave
