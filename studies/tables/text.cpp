#include "strainwave/studies/tables/text.hpp"

#include "strainwave/studies/tables/answer_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>

namespace strainwave {

using Json = nlohmann::ordered_json;

std::string number_in_words(double value) {
  return std::isfinite(value) ? fmt::format("{:.5g}", value) : "–";
}

std::string interval_in_words(const Interval& ci) {
  return fmt::format("[{}, {}]", number_in_words(ci.lower), number_in_words(ci.upper));
}

Json number_json(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json interval_json(const Interval& interval) {
  return Json::array({number_json(interval.lower), number_json(interval.upper)});
}

Json estimate_json(const Estimate& e) {
  return {{"value", number_json(e.value)}, {"ci95", interval_json(e.ci95)}};
}

std::string_view run_end_name(RunEnd end) {
  constexpr std::array<std::string_view, 6> names{"complete", "enough",     "time_limit",
                                                  "stopped",  "all_failed", "too_many_failed"};
  return names[static_cast<std::size_t>(end)];
}

std::string sampled_table(const SampledReport& report, const std::string& folder) {
  const StudyFile& study = report.study;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{}: {} of \"{}\"{}, {} rows{}\n\n", std::filesystem::path(study.file).stem().string(),
                 study.kind->name(), study.gear.name, study.reduced ? " (reduced study)" : "", report.rows,
                 report.shards > 1 ? fmt::format(", shard {}/{}", report.shard, report.shards) : "");
  if (report.answer)
    text += report.answer->text();
  fmt::format_to(out, "\nEvaluations  {} done, {} reused, {} failed; {:.1f} s\n", report.done - report.reused,
                 report.reused, report.failed, report.seconds);
  for (const RowFailures& f : report.failures)
    fmt::format_to(out, "             {} {}, for example row {}: {}\n", f.count, f.status, f.example_row,
                   f.example);
  if (!report.failures.empty())
    fmt::format_to(
        out,
        "             rows without a result are left out of all statistics; one again: strainwave eval "
        "--from {} --index {}\n",
        folder, report.failures.front().example_row);
  fmt::format_to(out, "Folder       {}\n", folder);
  return text;
}

Json sampled_json(const SampledReport& report, const std::string& folder) {
  Json json;
  json["kind"] = report.study.kind->name();
  json["study"] = report.study.file;
  json["reduced"] = report.study.reduced;
  json["complete"] = report.whole;
  json["end"] = run_end_name(report.end);
  json["message"] = report.sentence;
  json["rows"] = report.rows;
  if (report.shards > 1)
    json["shard"] = fmt::format("{}/{}", report.shard, report.shards);
  json["evaluations"] = {
      {"done", report.done - report.reused}, {"reused", report.reused}, {"failed", report.failed}};
  json["seconds"] = report.seconds;
  json["failures"] = Json::array();
  for (const RowFailures& f : report.failures)
    json["failures"].push_back(
        {{"status", f.status}, {"count", f.count}, {"example_row", f.example_row}, {"example", f.example}});
  if (report.answer) {
    json["ranges"] = Json::object();
    for (const OutputRange& range : report.ranges)
      json["ranges"][range.output] = {{"least", range.least},
                                      {"least_row", range.least_row},
                                      {"greatest", range.greatest},
                                      {"greatest_row", range.greatest_row}};
    report.answer->add_json(json);
  }
  json["folder"] = folder;
  return json;
}

} // namespace strainwave
