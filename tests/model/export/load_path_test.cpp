// A load path in files and figures: every event with its numbers.

#include "strainwave/common/files/hdf5.hpp"
#include "strainwave/model/export/figures.hpp"
#include "strainwave/model/export/result_file.hpp"
#include "strainwave/model/export/result_json.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "tests/model/export/folder.hpp"

#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace strainwave {
namespace {

struct PathAndResult {
  ForwardResult result;
  LoadPath path;
};

/// Of the seed gear on a coarse mesh, computed once.
const PathAndResult& seed_path() {
  static const PathAndResult both = [] {
    const Gear gear = testing_export::coarse_seed();
    ForwardModel model({.disk_cache = false});
    return PathAndResult{model.analyze(gear), model.load_path(gear).value()};
  }();
  return both;
}

TEST(LoadPathFiles, JsonHoldsEveryEventAndItsTeeth) {
  const auto& [result, path] = seed_path();
  const nlohmann::ordered_json json = result_json(result, &path);
  ASSERT_EQ(json["path"]["events"].size(), path.events.size());
  for (std::size_t k = 0; k < path.events.size(); ++k) {
    const auto& event = json["path"]["events"][k];
    EXPECT_EQ(event["rotation_rad"], path.events[k].rotation_rad);
    EXPECT_EQ(event["torque_nm"], path.events[k].torque_nm);
    EXPECT_EQ(event["stiffness_nm_per_rad"], path.events[k].stiffness_nm_per_rad);
    EXPECT_EQ(event["wall_joins"], path.events[k].wall_joins);
    ASSERT_EQ(event["changes"].size(), path.events[k].changes.size());
    for (std::size_t c = 0; c < path.events[k].changes.size(); ++c) {
      EXPECT_EQ(event["changes"][c]["tooth"], path.events[k].changes[c].point.tooth);
      EXPECT_EQ(event["changes"][c]["change"], path.events[k].changes[c].joins ? "joins" : "leaves");
    }
  }
  EXPECT_EQ(json["path"]["loads"].size(), result.load.size());
  EXPECT_FALSE(result_json(result).contains("path")); // nothing that was not asked for
}

TEST(LoadPathFiles, Hdf5HoldsTheSameWithUnits) {
  const auto& [result, path] = seed_path();
  const testing_export::TemporaryFolder folder;
  write_result_file(result, "name = \"x\"\n", folder / "result.h5", &path);
  const hdf5::File file(folder / "result.h5");
  EXPECT_EQ(file.dataset("config").read_text(), "name = \"x\"\n");
  const hdf5::Group events = file.group("path/events");
  const std::vector<double> torque = events.dataset("torque").read<double>();
  ASSERT_EQ(torque.size(), path.events.size());
  EXPECT_EQ(torque.back(), path.events.back().torque_nm);
  EXPECT_EQ(events.dataset("torque").text("units"), "N.m");
  EXPECT_EQ(events.dataset("stiffness").text("units"), "N.m/rad");
  const auto event = file.dataset("path/changes/event").read<std::int32_t>();
  const auto tooth = file.dataset("path/changes/tooth").read<std::int32_t>();
  const auto joins = file.dataset("path/changes/joins").read<std::int32_t>();
  ASSERT_EQ(event.size(), tooth.size());
  std::vector<std::size_t> taken(path.events.size(), 0);
  for (std::size_t k = 0; k < event.size(); ++k) {
    const auto at = static_cast<std::size_t>(event[k]);
    const LoadPathChange& change = path.events.at(at).changes.at(taken[at]++);
    EXPECT_EQ(tooth[k], change.point.tooth);
    EXPECT_EQ(joins[k], change.joins ? 1 : 0);
  }
  for (std::size_t at = 0; at < taken.size(); ++at)
    EXPECT_EQ(taken[at], path.events[at].changes.size());
  EXPECT_EQ(file.dataset("load/0000/peak_force").read<double>().at(0), result.load[0].peak_force_n);
}

TEST(LoadPathFiles, FigureMarksEveryEventOnce) {
  const auto& [result, path] = seed_path();
  const std::string bare = torque_rotation_figure(result, result).data;
  const std::string marked = torque_rotation_figure(result, result, &path).data;
  ASSERT_TRUE(marked.starts_with(bare));
  const auto rows = [](const std::string& text) {
    std::istringstream in(text);
    std::size_t count = 0;
    for (std::string line; std::getline(in, line);)
      count += !line.empty() && line[0] != '#';
    return count;
  };
  std::size_t both = 0; // one tooth begins where another ceases to carry
  for (const LoadPathEvent& event : path.events) {
    bool begins = false, ceases = false;
    for (const LoadPathChange& change : event.changes)
      (change.joins ? begins : ceases) |= change.whole_tooth;
    both += begins && ceases;
  }
  const std::string marks = marked.substr(bare.size());
  std::size_t empty = 0; // a block without events says nan
  for (std::size_t at = 0; (at = marks.find("nan nan nan nan", at)) != std::string::npos; ++at)
    ++empty;
  EXPECT_EQ(rows(marks), path.events.size() + both + empty);
}

} // namespace
} // namespace strainwave
