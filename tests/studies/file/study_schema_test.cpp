// The JSON Schema of study files, judged by an independent validator (python3-jsonschema), and the reference
// page.

#include "strainwave/studies/file/schema.hpp"

#include "strainwave/model/gear_file/toml_source.hpp"
#include "tests/studies/studies.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>

namespace strainwave {
namespace {

using Json = nlohmann::json;

Json image_of(const std::string& text) {
  std::stringstream json;
  json << toml::json_formatter(parse_toml(text, "study.toml"));
  return Json::parse(json.str());
}

/// For each instance, does it satisfy the schema? Also checks that the schema itself is legal 2020-12.
std::vector<bool> judgements(const std::vector<Json>& instances) {
  const TemporaryFolder folder;
  const std::string schema = folder.write("schema.json", study_json_schema(study_kinds()).dump());
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
  const std::string command = "/usr/bin/python3 " + program + " " + schema + " " + cases + " " + answer;
  EXPECT_EQ(std::system(command.c_str()), 0); // needs python3-jsonschema
  return Json::parse(file_text(answer)).get<std::vector<bool>>();
}

TEST(StudySchema, AcceptsTheGalleryAndRefusesSlips) {
  std::vector<Json> images;
  std::vector<bool> expected;
  const auto add = [&](const std::string& text, bool good) {
    images.push_back(image_of(text));
    expected.push_back(good);
  };
  const auto text_of = [](const char* name) {
    return file_text(STRAINWAVE_SOURCE "/studies/gallery/" + std::string(name) + ".toml");
  };
  for (const char* name :
       {"seed_optimize", "seed_optimize_coned", "seed_optimize_one_point", "seed_pareto", "seed_multi_load",
        "seed_relief_only", "seed_overnight_sweep", "seed_tolerance", "seed_sensitivity", "seed_convergence"})
    add(text_of(name), true);
  const std::string search = text_of("seed_optimize"), sweep = text_of("seed_overnight_sweep"),
                    sampled = text_of("seed_tolerance");
  add(edited(search, "\"optimize\"", "\"optimise\""), false);
  add(edited(search, "[objective]", "[objectiv]"), false);
  add(edited(search, "budget", "bugdet"), false);
  add(edited(sweep, "\"factorial\"", "\"full\""), false);
  add(edited(sweep, "\"sweep\"", "\"optimize\""), false);
  add(edited(sampled, "normal = {", "gaussian = {"), false);
  add(edited(sampled, "std = 0.43", "std = -0.43"), false);
  add(edited(sampled, "\"adjacent_pitch\"", "\"pitch\""), false);
  EXPECT_EQ(judgements(images), expected);
}

TEST(StudySchema, TheDocumentIsInStep) {
  EXPECT_EQ(file_text(STRAINWAVE_SOURCE "/docs/study-file.md"), study_reference_page(study_kinds()))
      << "renew it: strainwave schema --study --reference > docs/study-file.md";
}

} // namespace
} // namespace strainwave
