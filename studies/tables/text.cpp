#include "strainwave/studies/tables/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>

namespace strainwave {

namespace {

using Json = nlohmann::ordered_json;
using Out = std::back_insert_iterator<std::string>;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json interval_json(const Interval& interval) {
  return Json::array({number(interval.lower), number(interval.upper)});
}

Json estimate_json(const Estimate& e) {
  return {{"value", number(e.value)}, {"ci95", interval_json(e.ci95)}};
}

Json summary_json(const OutputStatistics& s) {
  const Summary& summary = *s.summary;
  Json json{
      {"samples", summary.samples}, {"mean", number(summary.mean.value)}, {"std", number(summary.std.value)}};
  Json quantiles = Json::object(), quantile_ends = Json::object();
  for (const QuantileEstimate& q : summary.quantiles) {
    quantiles[fmt::format("{}", q.probability)] = number(q.estimate.value);
    quantile_ends[fmt::format("{}", q.probability)] = interval_json(q.estimate.ci95);
  }
  json["quantiles"] = quantiles;
  json["exceeding"] = Json::array();
  for (const ExceedanceEstimate& e : summary.exceedances)
    json["exceeding"].push_back({{"limit", e.limit},
                                 {"probability", number(e.probability.value)},
                                 {"ci95", interval_json(e.probability.ci95)}});
  json["ci95"] = {{"mean", interval_json(summary.mean.ci95)},
                  {"std", interval_json(summary.std.ci95)},
                  {"quantiles", quantile_ends}};
  json["least"] = summary.least;
  json["greatest"] = summary.greatest;
  json["histogram"] = {{"lower", summary.histogram.lower},
                       {"upper", summary.histogram.upper},
                       {"counts", summary.histogram.counts}};
  Json correlations = Json::object();
  for (const SourceCorrelation& c : s.correlations)
    correlations[c.input] = {{"pearson", estimate_json(c.pearson)}, {"spearman", estimate_json(c.spearman)}};
  json["correlation"] = correlations;
  return json;
}

Json sobol_json(const SobolIndices& indices, const std::vector<std::string>& names) {
  Json json = Json::object();
  for (std::size_t i = 0; i < indices.inputs.size(); ++i) {
    const SobolIndex& index = indices.inputs[i];
    json[names[i]] = {
        {"first", number(index.first.value)},
        {"total", number(index.total.value)},
        {"ci95", {{"first", interval_json(index.first.ci95)}, {"total", interval_json(index.total.ci95)}}}};
  }
  return json;
}

Json morris_json(const MorrisResult& result, const std::vector<std::string>& names) {
  Json json = Json::object();
  for (std::size_t i = 0; i < result.inputs.size(); ++i) {
    const MorrisEffect& e = result.inputs[i];
    json[names[i]] = {
        {"mu", number(e.mu.value)},
        {"mu_star", number(e.mu_star.value)},
        {"sigma", number(e.sigma)},
        {"ci95", {{"mu", interval_json(e.mu.ci95)}, {"mu_star", interval_json(e.mu_star.ci95)}}}};
  }
  return json;
}

/// Sobol' indices and Morris effects of all outputs, and how many blocks they rest on.
void add_indices(Json& json, const SampledReport& report) {
  const SampledStatistics& all = report.statistics;
  Json indices = Json::object(), blocks = Json::object(), nested = Json::object();
  for (const OutputStatistics& s : all.outputs) {
    if (!s.sobol.empty()) {
      indices[s.output] = sobol_json(s.sobol.back(), all.index_names);
      blocks[s.output] = {{"used", s.sobol.back().blocks}, {"dropped", s.sobol.back().dropped_blocks}};
      nested[s.output] = Json::array();
      for (const SobolIndices& part : s.sobol)
        nested[s.output].push_back({{"blocks", part.blocks}, {"indices", sobol_json(part, all.index_names)}});
    } else if (s.morris) {
      indices[s.output] = morris_json(*s.morris, all.index_names);
      blocks[s.output] = {{"used", s.morris->trajectories}, {"dropped", s.morris->dropped_trajectories}};
    }
  }
  for (const LocalElasticity& e : all.elasticities)
    indices[e.output][e.input] = {{"derivative", number(e.derivative)}, {"elasticity", number(e.elasticity)}};
  json["indices"] = indices;
  json["blocks"] = blocks;
  if (!nested.empty())
    json["nested"] = nested;
}

std::string text_of(double value) {
  return std::isfinite(value) ? fmt::format("{:.5g}", value) : "–";
}

std::string ends_of(const Interval& ci) {
  return fmt::format("[{}, {}]", text_of(ci.lower), text_of(ci.upper));
}

void ranges_table(const SampledReport& report, Out out) {
  fmt::format_to(out, "  {:<30} {:>8} {:>12} {:>10} {:>12} {:>10}\n", "Outputs", "unit", "least", "at row",
                 "greatest", "at row");
  for (const OutputStatistics& s : report.statistics.outputs)
    if (s.range)
      fmt::format_to(out, "  {:<30} {:>8} {:>12} {:>10} {:>12} {:>10}\n", s.output, s.unit,
                     text_of(s.range->least), s.range->least_row, text_of(s.range->greatest),
                     s.range->greatest_row);
}

void summary_table(const OutputStatistics& s, Out out) {
  const auto line = [&](const std::string& name, const Estimate& e) {
    fmt::format_to(out, "    {:<34} {:>12}   {}\n", name, text_of(e.value), ends_of(e.ci95));
  };
  line("mean", s.summary->mean);
  line("standard deviation", s.summary->std);
  for (const QuantileEstimate& q : s.summary->quantiles)
    line(fmt::format("quantile {}", q.probability), q.estimate);
  for (const ExceedanceEstimate& e : s.summary->exceedances)
    line(fmt::format("probability above {}", e.limit), e.probability);
  for (const SourceCorrelation& c : s.correlations)
    line("correlation with " + c.input, c.pearson);
}

void outputs_table(const SampledReport& report, Out out) {
  const auto& names = report.statistics.index_names;
  for (const OutputStatistics& s : report.statistics.outputs) {
    fmt::format_to(out, "  {} ({}){}\n", s.output, s.unit, s.missing.empty() ? "" : ": " + s.missing);
    if (s.summary)
      summary_table(s, out);
    if (!s.sobol.empty()) {
      const SobolIndices& last = s.sobol.back();
      fmt::format_to(out, "    {} blocks, {} dropped; first and total index, 95 %\n", last.blocks,
                     last.dropped_blocks);
      for (std::size_t i = 0; i < last.inputs.size(); ++i)
        fmt::format_to(out, "    {:<34} {:>8} {:<20} {:>8} {}\n", names[i],
                       text_of(last.inputs[i].first.value), ends_of(last.inputs[i].first.ci95),
                       text_of(last.inputs[i].total.value), ends_of(last.inputs[i].total.ci95));
    }
    if (s.morris) {
      fmt::format_to(out,
                     "    {} trajectories, {} dropped; mean magnitude of effects, 95 %, and their spread\n",
                     s.morris->trajectories, s.morris->dropped_trajectories);
      for (std::size_t i = 0; i < s.morris->inputs.size(); ++i)
        fmt::format_to(out, "    {:<34} {:>12} {:<24} {:>12}\n", names[i],
                       text_of(s.morris->inputs[i].mu_star.value), ends_of(s.morris->inputs[i].mu_star.ci95),
                       text_of(s.morris->inputs[i].sigma));
    }
    for (const LocalElasticity& e : report.statistics.elasticities)
      if (e.output == s.output)
        fmt::format_to(out, "    {:<34} elasticity {:>12}   derivative {}\n", e.input, text_of(e.elasticity),
                       text_of(e.derivative));
  }
}

} // namespace

std::string_view run_end_name(RunEnd end) {
  constexpr std::array<std::string_view, 6> names{"complete", "enough",     "time_limit",
                                                  "stopped",  "all_failed", "too_many_failed"};
  return names[static_cast<std::size_t>(end)];
}

std::string sampled_table(const SampledReport& report, const std::string& folder) {
  const StudyFile& study = report.study;
  std::string text;
  const Out out(text);
  fmt::format_to(out, "{}: {} of \"{}\"{}, {} rows{}\n\n", std::filesystem::path(study.file).stem().string(),
                 study_kinds[static_cast<std::size_t>(study.kind)], study.gear.name,
                 study.reduced ? " (reduced study)" : "", report.rows,
                 report.shards > 1 ? fmt::format(", shard {}/{}", report.shard, report.shards) : "");
  if (study.kind == StudyKind::sweep && report.whole)
    ranges_table(report, out);
  else if (report.whole)
    outputs_table(report, out);
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
  json["kind"] = study_kinds[static_cast<std::size_t>(report.study.kind)];
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
  if (report.whole) {
    Json ranges = Json::object(), statistics = Json::object();
    for (const OutputStatistics& s : report.statistics.outputs) {
      if (s.range)
        ranges[s.output] = {{"least", s.range->least},
                            {"least_row", s.range->least_row},
                            {"greatest", s.range->greatest},
                            {"greatest_row", s.range->greatest_row}};
      statistics[s.output] = s.summary ? summary_json(s) : Json{{"missing", s.missing}};
    }
    json["ranges"] = ranges;
    if (report.study.kind == StudyKind::monte_carlo)
      json["statistics"] = statistics;
    if (report.study.kind == StudyKind::sensitivity)
      add_indices(json, report);
  }
  json["folder"] = folder;
  return json;
}

} // namespace strainwave
