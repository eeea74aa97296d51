#include "strainwave/studies/results/result_folder.hpp"

#include "strainwave/common/files/content_hash.hpp"
#include "strainwave/common/files/whole_file.hpp"
#include "strainwave/common/rows/merge.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/studies/file/kind.hpp"
#include "strainwave/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace strainwave {

namespace fs = std::filesystem;

namespace {

constexpr const char* plan_name = "plan.json";

nlohmann::json read_json(const fs::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file, nullptr, false);
}

} // namespace

ResultFolder::ResultFolder(fs::path path) : path_(std::move(path)) {
  fs::create_directories(path_);
}

void ResultFolder::write_text(const char* name, std::string_view text) const {
  write_whole_text(path_ / name, text);
}

fs::path ResultFolder::journal(std::uint32_t shard, std::uint32_t shards) const {
  fs::create_directories(path_ / "shards");
  return shard_journal(path_, shard, shards);
}

std::string known_verdict(const fs::path& folder) {
  const auto known = read_json(folder / "result.json");
  return known.is_object() ? known.value("verdict", "") : "";
}

std::string ResultFolder::occupied(const StudyFile& study) const {
  const auto plan = read_json(path_ / plan_name);
  if (!plan.is_object() || !plan.contains("hash")) {
    for (const auto& entry : fs::directory_iterator(path_)) // another shard may be writing the plan right now
      if (!entry.path().filename().string().starts_with(plan_name))
        return fmt::format("{} is not empty and not the folder of a study; give another one with --out",
                           path_.string());
    return {};
  }
  if (plan["hash"] != hash_text(plan_hash(study)))
    return fmt::format(
        "{} holds the results of another study (or of an earlier state of this one); give another "
        "folder with --out, or remove it",
        path_.string());
  return {};
}

void ResultFolder::write_plan(const StudyFile& study) const {
  const auto known = read_json(path_ / plan_name);
  if (known.is_object() && known.value("hash", "") == hash_text(plan_hash(study)))
    return;
  nlohmann::ordered_json plan;
  plan["kind"] = study.kind->name();
  plan["name"] = fs::path(study.file).stem().string();
  plan["version"] = library_version;
  plan["hash"] = hash_text(plan_hash(study));
  plan["seed"] = study.seed;
  plan["reduced"] = study.reduced;
  plan["inputs"] = study.kind->plan_inputs(study);
  plan["points"] = study.kind->plan_points(study);
  plan["study"] = write_study(study);
  plan["gear"] = write_gear(study.gear);
  write_text(plan_name, plan.dump(2) + "\n");
}

StudyFile read_plan(const fs::path& folder, StudyKinds kinds) {
  const std::string path = (folder / plan_name).string();
  const auto refuse = [&](std::string sentence) -> FileError {
    return FileError(path, {{{1, 1}, "", std::move(sentence), ""}});
  };
  if (!fs::exists(path))
    throw refuse("there is no such file: this is not the folder of a study");
  const auto plan = read_json(path);
  for (const char* key : {"study", "gear", "hash", "version", "name"})
    if (!plan.is_object() || !plan.contains(key) || !plan[key].is_string())
      throw refuse(fmt::format("is no plan of a study: \"{}\" is missing", key));
  if (plan["version"] != library_version)
    throw refuse(fmt::format("was made by version {}, this is {}; use that version or run the study again",
                             plan["version"].get<std::string>(), library_version));
  StudyFile study =
      restore_study(plan["study"].get<std::string>(), plan["gear"].get<std::string>(), path, kinds);
  study.file = plan["name"].get<std::string>() + ".toml";
  study.reduced = plan.value("reduced", false);
  if (hash_text(plan_hash(study)) != plan["hash"])
    throw refuse("its hash does not fit its content: it has been changed by hand, or made by another build "
                 "of this version");
  return study;
}

std::uint64_t plan_hash(const StudyFile& study) {
  StudyFile placeless = study;
  placeless.gear_file = "gear.toml"; // what counts is its content
  return content_hash(write_study(placeless) + canonical_bits(study.gear) + library_version);
}

std::string config_text(const StudyFile& study) {
  StudyFile placeless = study;
  placeless.gear_file = fs::path(study.gear_file).filename().string(); // the same bits in every folder
  return write_study(placeless) + "\n# gear\n" + write_gear(study.gear);
}

std::string_view study_version() {
  return library_version;
}

fs::path default_result_folder(const StudyFile& study) {
  return fs::path(study.file).stem().string() + (study.reduced ? "-reduced-result" : "-result");
}

} // namespace strainwave
