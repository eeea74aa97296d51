#include "studies/result_folder.hpp"

#include "model/gear/fields.hpp"
#include "model/gear_file/gear_file.hpp"
#include "studies/optimisation_text.hpp"
#include "studies/results_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace strainwave {

namespace fs = std::filesystem;

ResultFolder::ResultFolder(fs::path path) : path_(std::move(path)) {
  fs::create_directories(path_);
}

void ResultFolder::write_text(const char* name, std::string_view text) const {
  const fs::path target = path_ / name;
  const fs::path beside = target.string() + ".part";
  errno = 0;
  std::ofstream file(beside, std::ios::binary);
  file << text;
  file.close();
  if (!file)
    throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(),
                            "cannot write " + target.string());
  fs::rename(beside, target);
}

std::string ResultFolder::occupied(const StudyFile& study) const {
  if (fs::is_empty(path_))
    return {};
  std::ifstream file(path_ / "plan.json");
  const auto plan = nlohmann::json::parse(file, nullptr, false);
  if (!plan.is_object() || !plan.contains("hash"))
    return fmt::format("{} is not empty and not the folder of a study; give another one with --out", path_.string());
  if (plan["hash"] != plan_hash(study))
    return fmt::format("{} holds the results of another study (or of an earlier state of this one); give another "
                       "folder with --out, or remove it",
                       path_.string());
  return {};
}

void ResultFolder::write_plan(const StudyFile& study) const {
  nlohmann::ordered_json plan;
  plan["kind"] = study.kind == StudyKind::pareto ? "pareto" : "optimize";
  plan["version"] = STRAINWAVE_VERSION;
  plan["hash"] = plan_hash(study);
  plan["seed"] = study.seed;
  plan["reduced"] = study.reduced;
  plan["inputs"] = nlohmann::ordered_json::array();
  for (const StudyVariable& v : study.variables)
    plan["inputs"].push_back({{"path", v.path}, {"lower", v.lower}, {"upper", v.upper}});
  plan["points"] = "chosen one after the other by the method";
  plan["study"] = write_study(study);
  plan["gear"] = write_gear(study.gear);
  write_text("plan.json", plan.dump(2) + "\n");
}

bool ResultFolder::write_results(const OptimisationReport& report) const {
  if (report.verdict == Verdict::stopped) {
    std::ifstream file(path_ / "result.json");
    const auto earlier = nlohmann::json::parse(file, nullptr, false);
    if (earlier.is_object() && earlier.value("verdict", "stopped") != "stopped")
      return false;
  }
  write_results_file(report, path_ / "results.h5");
  write_text("result.json", optimisation_json(report, path_.string()).dump(2) + "\n");
  if (report.best_gear)
    write_text("best.toml", write_gear(*report.best_gear));
  return true;
}

std::string plan_hash(const StudyFile& study) {
  std::uint64_t hash = 14695981039346656037u; // FNV-1a, 64 bits
  for (const std::string& part :
       {write_study(study), canonical_bits(study.gear), std::string(STRAINWAVE_VERSION)})
    for (const char byte : part)
      hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

fs::path default_result_folder(const StudyFile& study) {
  return fs::path(study.file).stem().string() + (study.reduced ? "-reduced-result" : "-result");
}

} // namespace strainwave
