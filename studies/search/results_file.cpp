#include "strainwave/studies/search/results_file.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/common/files/content_hash.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/studies/results/results_table.hpp"
#include "strainwave/studies/results/row_status.hpp"
#include "strainwave/studies/search/text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace strainwave {

namespace {

std::uint8_t status_of(const Evaluation& e, const std::vector<std::string>& names) {
  const auto known = std::ranges::find(names, e.status);
  return known != names.end() ? static_cast<std::uint8_t>(known - names.begin()) : row_out_of_range;
}

RowTable table_of(const OptimisationReport& report, const std::vector<std::string>& names) {
  const auto outputs = static_cast<std::uint32_t>(gear_responses().size());
  RowTable table(report.points.size(), outputs, 1);
  for (std::size_t i = 0; i < report.points.size(); ++i) {
    const Evaluation& e = *report.points[i].evaluation;
    RowBlock block{.first = i, .rows = 1, .outputs = outputs, .seconds = report.points[i].seconds};
    block.status = {e.ok ? row_ok : status_of(e, names)};
    block.values = e.ok ? e.values : std::vector<double>(outputs, 0.0);
    if (!e.ok)
      block.messages.push_back({0, e.message});
    table.insert(block);
  }
  return table;
}

} // namespace

void write_results_file(const OptimisationReport& report, const std::filesystem::path& path) {
  if (report.points.empty())
    return; // stopped before the first evaluation
  ResultsTable results;
  for (std::size_t i = 0; i < report.study.part<SearchPart>().variables.size(); ++i)
    results.inputs.push_back({report.inputs[i].path, plain_unit(report.inputs[i].unit)});
  for (const Response& response : gear_responses())
    results.outputs.push_back({std::string(response.name), plain_unit(response.unit)});
  results.input_rows = [&](std::uint64_t first, std::size_t count, std::span<double> rows) {
    for (std::size_t k = 0; k < count; ++k)
      std::ranges::copy(report.points[first + k].x,
                        rows.begin() + static_cast<std::ptrdiff_t>(k * results.inputs.size()));
  };
  results.status_names = row_status_names();
  results.config = config_text(report.study);
  results.version = study_version();
  results.plan_hash = plan_hash(report.study);
  results.model_hash = search_model_hash();
  write_results_table(results, table_of(report, results.status_names), path);
}

bool write_search_results(const ResultFolder& folder, const OptimisationReport& report) {
  if (report.verdict == Verdict::stopped) {
    const std::string known = known_verdict(folder.path());
    if (!known.empty() && known != "stopped")
      return false;
  }
  write_results_file(report, folder.path() / "results.h5");
  folder.write_text("result.json", optimisation_json(report, folder.path().string()).dump(2) + "\n");
  if (report.best_gear)
    folder.write_text("best.toml", write_gear(*report.best_gear));
  return true;
}

std::uint64_t search_model_hash() {
  return content_hash(std::string(study_version()) + " search 2");
}

} // namespace strainwave
