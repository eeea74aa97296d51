// Tables of a study's report, from result.json.

#include "strainwave/studies/report/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace strainwave {

namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& value) {
  if (value.is_number())
    return fmt::format("{:.5g}", value.get<double>());
  return value.is_string() ? escape_html(value.get<std::string>()) : "–";
}

std::string ends(const Json& ci) {
  return ci.is_array() && ci.size() == 2 ? fmt::format("[{}, {}]", text(ci[0]), text(ci[1])) : "";
}

/// First cell a name, all others numbers.
std::string row(const std::string& name, const std::vector<std::string>& cells, const char* tag = "td") {
  std::string html = fmt::format("<tr><{0}>{1}</{0}>", tag, escape_html(name));
  for (const std::string& cell : cells)
    html += fmt::format("<{0} class=n>{1}</{0}>", tag, cell);
  return html + "</tr>\n";
}

std::string heading(const std::string& name, const std::vector<std::string>& cells) {
  return "<table>" + row(name, cells, "th");
}

std::string before_and_after(const Json& result) {
  std::string html;
  const bool found = result["best"].is_object();
  for (const auto& [title, key] : {std::pair{"Inputs", "inputs"}, {"Outputs", "outputs"}}) {
    html += heading(title, {"unmodified", "optimised", "change"});
    for (const auto& [name, value] : result["baseline"][key].items()) {
      if (!value.is_number())
        continue;
      const Json after = found ? result["best"][key][name] : Json(nullptr);
      std::string change;
      if (after.is_number() && value.get<double>() != 0.0)
        change = fmt::format("{:+.1f} %", 100.0 * (after.get<double>() / value.get<double>() - 1.0));
      html += row(name, {text(value), text(after), change});
    }
    html += "</table>\n";
  }
  if (!result["limits"].empty()) {
    html += heading("Limits", {"at least", "at most", "value", "kept"});
    for (const Json& l : result["limits"])
      html += row(l["output"],
                  {text(l.value("min", Json())), text(l.value("max", Json())), text(l.value("value", Json())),
                   l.value("kept", false) ? "yes" : "<span class=bad>no</span>"});
    html += "</table>\n";
  }
  return html;
}

std::string front(const StudyFile& study, const Json& result) {
  std::string html = "<h2>Front</h2>\n" + heading("verdict", {study.objective.output, study.pareto.output});
  for (const Json& point : result["front"]) {
    const bool there = point["outputs"].is_object();
    html += row(point["verdict"], {there ? text(point["outputs"][study.objective.output]) : "–",
                                   there ? text(point["outputs"][study.pareto.output]) : "–"});
  }
  return html + "</table>\n";
}

std::string ranges(const Json& result) {
  std::string html = heading("Output", {"least", "at row", "greatest", "at row"});
  for (const auto& [name, r] : result["ranges"].items())
    html += row(name, {text(r["least"]), fmt::format("{}", r["least_row"].get<std::uint64_t>()),
                       text(r["greatest"]), fmt::format("{}", r["greatest_row"].get<std::uint64_t>())});
  return html + "</table>\n";
}

std::string statistics(const Json& result) {
  std::string html;
  for (const auto& [name, s] : result["statistics"].items()) {
    html += fmt::format("<h2>{}</h2>\n", escape_html(name));
    if (s.contains("missing")) {
      html += fmt::format("<p class=bad>{}</p>\n", text(s["missing"]));
      continue;
    }
    html += heading(fmt::format("{} samples", s["samples"].get<std::uint64_t>()), {"value", "95 %"});
    html += row("mean", {text(s["mean"]), ends(s["ci95"]["mean"])});
    html += row("standard deviation", {text(s["std"]), ends(s["ci95"]["std"])});
    for (const auto& [p, value] : s["quantiles"].items())
      html += row("quantile " + p, {text(value), ends(s["ci95"]["quantiles"][p])});
    for (const Json& e : s["exceeding"])
      html += row(fmt::format("probability above {}", e["limit"].get<double>()),
                  {text(e["probability"]), ends(e["ci95"])});
    for (const auto& [input, c] : s["correlation"].items())
      html += row("correlation with " + input, {text(c["pearson"]["value"]), ends(c["pearson"]["ci95"])});
    html += "</table>\n";
  }
  return html;
}

std::string indices(const Json& result) {
  std::string html;
  for (const auto& [output, inputs] : result["indices"].items()) {
    html += fmt::format("<h2>{}</h2>\n", escape_html(output));
    if (const auto blocks = result["blocks"].find(output); blocks != result["blocks"].end())
      html += fmt::format("<p>{} blocks, {} dropped because a row of them failed.</p>\n",
                          (*blocks)["used"].get<std::uint64_t>(), (*blocks)["dropped"].get<std::uint64_t>());
    if (inputs.empty())
      continue;
    std::vector<std::string> keys, titles;
    for (const auto& [key, value] : inputs.begin()->items())
      if (value.is_number() || value.is_null()) {
        keys.push_back(key);
        titles.push_back(key);
        titles.emplace_back("95 %");
      }
    html += heading("Source", titles);
    for (const auto& [input, index] : inputs.items()) {
      std::vector<std::string> cells;
      for (const std::string& key : keys) {
        cells.push_back(text(index[key]));
        const bool known = index.contains("ci95") && index["ci95"].contains(key);
        cells.push_back(known ? ends(index["ci95"][key]) : "");
      }
      html += row(input, cells);
    }
    html += "</table>\n";
  }
  return html;
}

} // namespace

std::string report_tables(const StudyFile& study, const Json& result) {
  switch (study.kind) {
  case StudyKind::optimize:
    return before_and_after(result);
  case StudyKind::pareto:
    return before_and_after(result) + (result.contains("front") ? front(study, result) : "");
  case StudyKind::sweep:
    return result.contains("ranges") ? ranges(result) : "";
  case StudyKind::monte_carlo:
    return result.contains("statistics") ? statistics(result) : "";
  case StudyKind::sensitivity:
    break;
  }
  return result.contains("indices") ? indices(result) : "";
}

} // namespace strainwave
