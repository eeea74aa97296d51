// The JSON Schema, judged by an independent validator (python3-jsonschema), and the reference page.

#include "strainwave/model/gear_file/gear_schema.hpp"

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/gear_file/toml_source.hpp"
#include "tests/model/gear_file/files.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>

namespace strainwave {
namespace {

using Json = nlohmann::json;

Json image_of(const std::string& text) {
  std::stringstream json;
  json << toml::json_formatter(parse_toml(text, "gear.toml"));
  return Json::parse(json.str());
}

/// For each instance, does it satisfy the schema? Also checks that the schema itself is legal 2020-12.
std::vector<bool> judgements(const std::vector<Json>& instances) {
  const TemporaryFolder folder;
  const std::string schema = folder.write("schema.json", json_schema().dump());
  const std::string cases = folder.write("instances.json", Json(instances).dump());
  const std::string program = folder.write("judge.py", R"(
import json, sys
from jsonschema import Draft202012Validator as Validator
schema = json.load(open(sys.argv[1]))
Validator.check_schema(schema)
judge = Validator(schema)
print(json.dumps([judge.is_valid(instance) for instance in json.load(open(sys.argv[2]))]), file=open(sys.argv[3], "w"))
)");
  const std::string answer = (folder / "answer.json").string();
  const std::string command =
      std::string(PYTHON3) + " " + program + " " + schema + " " + cases + " " + answer;
  EXPECT_EQ(std::system(command.c_str()), 0); // needs python3-jsonschema
  return Json::parse(file_text(answer)).get<std::vector<bool>>();
}

TEST(GearSchema, AgreesWithTheProgramOnGoodAndBadFiles) {
  const std::string seed = file_text(seed_path);
  std::vector<std::string> texts{seed, write_gear(seed_gear())};
  const auto add = [&](const std::string& before, const std::string& after) {
    texts.push_back(edited(seed, before, after));
  };
  add("teeth = 140", "teeth = 0");
  add("module_mm = 0.2", "module_mm = 0.0");
  add("module_mm = 0.2", "modul_mm = 0.2");
  add("module_mm = 0.2", "module_mm = \"0.2\"");
  add("module_mm = 0.2", "#");
  add("[mesh]", "[meshes]");
  add("\"two_disc_exact\"", "\"disc\"");
  add("window_deg = []", "window_deg = [-21.0, 51.0]");
  add("window_deg = []", "window_deg = [-21.0]");
  add("torque_nm = [1.0, 7.0, 11.5]", "torque_nm = [-1.0]");
  add("torque_nm = [1.0, 7.0, 11.5]", "torque_nm = 7.0");
  add("[circular_spline] ", "[flank_modification] #");
  add("spline_um = []", "spline_um = [0, 1.5]");
  std::vector<Json> images;
  for (const std::string& text : texts)
    images.push_back(image_of(text));
  const std::vector<bool> legal = judgements(images);
  ASSERT_EQ(legal.size(), texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i)
    EXPECT_EQ(legal[i], complaint_about(texts[i]) == "no error") << i;
}

TEST(GearSchema, HoldsEveryFieldWithItsDefault) {
  const auto schema = json_schema();
  for (const Field& field : gear_fields()) {
    const nlohmann::ordered_json* node = &schema;
    std::stringstream steps{std::string(field.path)};
    for (std::string step; std::getline(steps, step, '.');) {
      EXPECT_EQ(node->at("additionalProperties"), false);
      node = &node->at("properties").at(step);
    }
    EXPECT_EQ(node->contains("default"), !field.required && !field.may_be_absent) << field.path;
  }
}

TEST(ReferencePage, TheDocumentIsInStep) {
  EXPECT_EQ(file_text(STRAINWAVE_SOURCE "/docs/gear-file.md"), reference_page())
      << "renew it: strainwave schema --reference > docs/gear-file.md";
}

} // namespace
} // namespace strainwave
