// The table of result fields against what JSON and HDF5 hold, and against docs/results.md.

#include "strainwave/common/files/hdf5.hpp"
#include "strainwave/model/export/result_file.hpp"
#include "strainwave/model/export/result_json.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/results/result_fields.hpp"
#include "tests/support/coarse_seed.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

namespace strainwave {
namespace {

using Json = nlohmann::ordered_json;
using testing_support::TemporaryFolder;

/// Several points, phases and loads, gaps of the assembled cup.
const ForwardResult& full_result() {
  static const ForwardResult result = [] {
    Gear gear = testing_support::coarse_seed_gear(testing_support::two_row_mesh);
    gear.contact.flank_points = 3;
    gear.contact.face_slices = 3;
    gear.contact.gaps = GapModel::assembled;
    gear.load.torque_nm = {2.0, 7.0};
    gear.load.phases = 2;
    ForwardModel model({.disk_cache = false});
    return model.analyze(gear, Want::load);
  }();
  return result;
}

/// "load[].points.force_n" of every number and array of numbers, texts and null.
void collect(const Json& json, const std::string& path, std::set<std::string>& keys,
             std::set<std::string>& blocks) {
  for (const auto& [name, value] : json.items()) {
    const std::string here = path.empty() ? name : path + '.' + name;
    if (value.is_object()) {
      blocks.insert(here);
      collect(value, here, keys, blocks);
    } else if (value.is_array() && !value.empty() && value.front().is_object()) {
      blocks.insert(here + "[]");
      for (const Json& element : value)
        collect(element, here + "[]", keys, blocks);
    } else {
      keys.insert(here);
    }
  }
}

TEST(ResultFields, JsonHoldsTheKeysOfTheTableAndNoOthers) {
  ASSERT_EQ(full_result().status, Status::ok) << full_result().message;
  std::set<std::string> keys, blocks;
  collect(result_json(full_result()), "", keys, blocks);
  std::set<std::string> table;
  for (const BlockText& block : result_blocks()) {
    if (!block.path.empty() && !blocks.contains(std::string(block.path))) {
      // Of this free gear without coast contact.
      EXPECT_TRUE(block.path.starts_with("load[].coast") || block.path == "wedge") << block.path;
      continue;
    }
    for (const FieldText& field : block.fields)
      table.insert(block.path.empty() ? std::string(field.name)
                                      : std::string(block.path) + '.' + std::string(field.name));
  }
  keys.erase("wedge"); // null: there is none
  EXPECT_EQ(keys, table);
}

TEST(ResultFields, EveryFieldSaysWhatItIs) {
  for (const BlockText& block : result_blocks()) {
    for (const FieldText& field : block.fields) {
      EXPECT_FALSE(field.sentence.empty()) << block.path << ' ' << field.name;
      EXPECT_EQ(field.unit.empty(), ascii_unit(field.unit) == "1") << block.path << ' ' << field.name;
      // The unit is in the name, but for times.
      EXPECT_EQ(name_without_unit(field) == field.name, field.unit.empty() || field.unit == "s")
          << block.path << ' ' << field.name;
    }
  }
}

/// What JSON holds is in the group, under its name without unit, with unit and sentence.
void expect_same(const Json& json, const hdf5::Group& group, const BlockText& block) {
  for (const FieldText& field : block.fields) {
    SCOPED_TRACE(std::string(block.path) + ' ' + std::string(field.name));
    const std::string key(field.name), name(name_without_unit(field));
    if (!json.contains(key) || json[key].is_null())
      continue;
    const hdf5::Dataset dataset = group.dataset(name);
    if (json[key].is_string()) {
      EXPECT_EQ(dataset.read_text(), json[key].get<std::string>());
      continue;
    }
    EXPECT_EQ(dataset.text("units"), ascii_unit(field.unit));
    EXPECT_EQ(dataset.text("description"), field.sentence);
    std::vector<double> expected;
    hdf5::Shape shape;
    std::function<void(const Json&)> flatten = [&](const Json& value) {
      if (value.is_array())
        std::for_each(value.begin(), value.end(), flatten);
      else if (value.is_boolean())
        expected.push_back(value.get<bool>() ? 1.0 : 0.0);
      else
        expected.push_back(value.is_null() ? std::nan("") : value.get<double>());
    };
    flatten(json[key]);
    for (const Json* axis = &json[key]; axis->is_array(); axis = &axis->front())
      shape.push_back(axis->size());
    EXPECT_EQ(dataset.shape(), shape);
    std::vector<double> found(expected.size());
    ASSERT_GE(H5LTread_dataset_double(group.id(), name.c_str(), found.data()), 0);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_TRUE(found[i] == expected[i] || (std::isnan(found[i]) && std::isnan(expected[i]))) << i;
    if (!field.rows.empty()) {
      EXPECT_EQ(H5DSget_num_scales(dataset.id(), 0), 1);
    }
    if (!field.columns.empty()) {
      EXPECT_EQ(H5DSget_num_scales(dataset.id(), 1), 1);
    }
  }
}

TEST(ResultFields, Hdf5HoldsWhatJsonHolds) {
  const TemporaryFolder folder;
  write_result_file(full_result(), "name = \"seed\"\n", folder / "result.h5");
  const Json json = result_json(full_result());
  const hdf5::File file(folder / "result.h5");
  EXPECT_EQ(file.format().name, "strainwave result");
  EXPECT_EQ(file.dataset("config").read_text(), "name = \"seed\"\n");
  std::size_t compared = 0;
  std::function<void(const Json&, const hdf5::Group&, const std::string&)> walk =
      [&](const Json& here, const hdf5::Group& group, const std::string& path) {
        for (const BlockText& block : result_blocks()) {
          if (block.path == path) {
            expect_same(here, group, block);
            ++compared;
          }
        }
        for (const auto& [name, value] : here.items()) {
          const std::string below = path.empty() ? name : path + '.' + name;
          if (value.is_object()) {
            walk(value, group.group(name), below);
          } else if (value.is_array() && !value.empty() && value.front().is_object()) {
            for (std::size_t i = 0; i < value.size(); ++i)
              walk(value[i], group.group(name).group("000" + std::to_string(i)), below + "[]");
          }
        }
      };
  walk(json, file, "");
  EXPECT_GE(compared, 12u);
}

TEST(ResultFields, PageHoldsTheTable) {
  const std::string page = testing_support::text_of(STRAINWAVE_SOURCE "/docs/results.md");
  EXPECT_NE(page.find("begin -->\n" + results_reference() + "<!-- schema --results: end"), std::string::npos)
      << "put `strainwave schema --results` between the marks of docs/results.md";
}

} // namespace
} // namespace strainwave
