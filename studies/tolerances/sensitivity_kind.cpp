// The kind "sensitivity": its keys, checks, indices and page.

#include "strainwave/common/statistics/morris.hpp"
#include "strainwave/common/statistics/sobol_indices.hpp"
#include "strainwave/studies/file/key_rows.hpp"
#include "strainwave/studies/report/page.hpp"
#include "strainwave/studies/tables/answer_text.hpp"
#include "strainwave/studies/tolerances/outputs.hpp"
#include "strainwave/studies/tolerances/sensitivity.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <stdexcept>

namespace strainwave {

using namespace study_rows;
using Json = nlohmann::ordered_json;

// ---- keys

static std::span<const std::string_view> names_of(SensitivityMethod) {
  static constexpr std::array<std::string_view, 3> names{"sobol", "morris", "local"};
  return names;
}

static StudyKeys study_keys(const StudySensitivity&) {
  static const std::array keys{
      choice_row<&StudySensitivity::method>("method",
                                            "Sobol' indices, Morris screening, or local elasticities"),
      row<&StudySensitivity::samples>("samples", "", within(2, 1073741824.0),
                                      "blocks (sobol, a power of two) or trajectories (morris)"),
      row<&StudySensitivity::positions>("positions", "", within(1, 100000),
                                        "positions of the wave generator; a row is the worst of them"),
      row<&StudySensitivity::levels>("levels", "", within(2, 1000), "morris: levels of each source, even"),
      outputs_row<&StudySensitivity::outputs>(),
  };
  return keys;
}

namespace {

void check_sensitivity(StudyChecker& checker) {
  const auto& part = checker.study().part<SensitivityPart>();
  for (std::size_t i = 0; i < part.correlations.size(); ++i)
    checker.fault(fmt::format("correlation[{}]", i),
                  "Sobol' indices, Morris screening and elasticities want independent sources");
  const StudySensitivity& s = part.sensitivity;
  checker.check_names("sensitivity.outputs", s.outputs, sampled_response_names(), sampled_counterparts());
  const std::string key = checker.given("sensitivity.samples") ? "sensitivity.samples" : "sensitivity";
  if (s.method == SensitivityMethod::sobol &&
      (s.samples < 8 || !std::has_single_bit(static_cast<unsigned>(s.samples))))
    checker.fault(key, fmt::format("must be a power of two, at least 8, is {}", s.samples));
  if (s.method == SensitivityMethod::morris && s.levels % 2 != 0)
    checker.fault("sensitivity.levels", fmt::format("must be even, is {}", s.levels));
}

// ---- indices

struct OutputIndices {
  std::string output, unit;
  std::vector<SobolIndices> sobol; ///< nested sample sizes, the whole sample last
  std::optional<MorrisResult> morris;
  std::string missing; ///< why there is none: too few rows with a result
};

/// All rows of one output, failed ones with whatever stands there.
std::vector<double> whole_column(const RowTable& table, std::uint32_t output) {
  std::vector<double> column(table.rows());
  for (std::uint64_t row = 0; row < table.rows(); ++row)
    column[row] = table.value(row, output);
  return column;
}

void find_indices(const StudyFile& study, const SampledStudy& rows, const RowTable& table, OutputIndices& s,
                  std::uint32_t output) {
  const StudySensitivity& wanted = study.part<SensitivityPart>().sensitivity;
  try {
    if (wanted.method == SensitivityMethod::sobol)
      s.sobol = nested_sobol_indices(whole_column(table, output), table.status(), rows.index_names.size(),
                                     std::min<std::uint64_t>(64, static_cast<std::uint64_t>(wanted.samples)),
                                     {.seed = static_cast<std::uint64_t>(study.seed)});
    else if (wanted.method == SensitivityMethod::morris && rows.morris)
      s.morris = morris_effects(*rows.morris, whole_column(table, output), table.status());
  } catch (const std::invalid_argument&) {
    s.missing = "too few whole blocks of rows with a result for indices";
  }
}

Json sobol_json(const SobolIndices& indices, const std::vector<std::string>& names) {
  Json json = Json::object();
  for (std::size_t i = 0; i < indices.inputs.size(); ++i) {
    const SobolIndex& index = indices.inputs[i];
    json[names[i]] = {
        {"first", number_json(index.first.value)},
        {"total", number_json(index.total.value)},
        {"ci95", {{"first", interval_json(index.first.ci95)}, {"total", interval_json(index.total.ci95)}}}};
  }
  return json;
}

Json morris_json(const MorrisResult& result, const std::vector<std::string>& names) {
  Json json = Json::object();
  for (std::size_t i = 0; i < result.inputs.size(); ++i) {
    const MorrisEffect& e = result.inputs[i];
    json[names[i]] = {
        {"mu", number_json(e.mu.value)},
        {"mu_star", number_json(e.mu_star.value)},
        {"sigma", number_json(e.sigma)},
        {"ci95", {{"mu", interval_json(e.mu.ci95)}, {"mu_star", interval_json(e.mu_star.ci95)}}}};
  }
  return json;
}

class SensitivityAnswer : public RowAnswer {
public:
  SensitivityAnswer(const StudyFile& study, const SampledStudy& rows, const RowTable& table)
      : index_names_(rows.index_names) {
    for (std::uint32_t output = 0; output < table.outputs(); ++output) {
      OutputIndices s{.output = rows.output_columns[output].name,
                      .unit = rows.output_columns[output].unit,
                      .sobol = {},
                      .morris = {},
                      .missing = {}};
      if (table.failed() == table.done())
        s.missing = "no row has a result";
      else
        find_indices(study, rows, table, s, output);
      outputs_.push_back(std::move(s));
    }
    if (rows.elasticities && table.failed() == 0)
      elasticities_ = rows.elasticities(table);
  }

  std::string text() const override {
    std::string text;
    const auto out = std::back_inserter(text);
    for (const OutputIndices& s : outputs_) {
      fmt::format_to(out, "  {} ({}){}\n", s.output, s.unit, s.missing.empty() ? "" : ": " + s.missing);
      if (!s.sobol.empty()) {
        const SobolIndices& last = s.sobol.back();
        fmt::format_to(out, "    {} blocks, {} dropped; first and total index, 95 %\n", last.blocks,
                       last.dropped_blocks);
        for (std::size_t i = 0; i < last.inputs.size(); ++i)
          fmt::format_to(
              out, "    {:<34} {:>8} {:<20} {:>8} {}\n", index_names_[i],
              number_in_words(last.inputs[i].first.value), interval_in_words(last.inputs[i].first.ci95),
              number_in_words(last.inputs[i].total.value), interval_in_words(last.inputs[i].total.ci95));
      }
      if (s.morris) {
        fmt::format_to(out,
                       "    {} trajectories, {} dropped; mean magnitude of effects, 95 %, and their spread\n",
                       s.morris->trajectories, s.morris->dropped_trajectories);
        for (std::size_t i = 0; i < s.morris->inputs.size(); ++i)
          fmt::format_to(out, "    {:<34} {:>12} {:<24} {:>12}\n", index_names_[i],
                         number_in_words(s.morris->inputs[i].mu_star.value),
                         interval_in_words(s.morris->inputs[i].mu_star.ci95),
                         number_in_words(s.morris->inputs[i].sigma));
      }
      for (const LocalElasticity& e : elasticities_)
        if (e.output == s.output)
          fmt::format_to(out, "    {:<34} elasticity {:>12}   derivative {}\n", e.input,
                         number_in_words(e.elasticity), number_in_words(e.derivative));
    }
    return text;
  }

  /// Indices and effects of all outputs, and how many blocks they rest on.
  void add_json(Json& result) const override {
    Json indices = Json::object(), blocks = Json::object(), nested = Json::object();
    for (const OutputIndices& s : outputs_) {
      if (!s.sobol.empty()) {
        indices[s.output] = sobol_json(s.sobol.back(), index_names_);
        blocks[s.output] = {{"used", s.sobol.back().blocks}, {"dropped", s.sobol.back().dropped_blocks}};
        nested[s.output] = Json::array();
        for (const SobolIndices& part : s.sobol)
          nested[s.output].push_back({{"blocks", part.blocks}, {"indices", sobol_json(part, index_names_)}});
      } else if (s.morris) {
        indices[s.output] = morris_json(*s.morris, index_names_);
        blocks[s.output] = {{"used", s.morris->trajectories}, {"dropped", s.morris->dropped_trajectories}};
      }
    }
    for (const LocalElasticity& e : elasticities_)
      indices[e.output][e.input] = {{"derivative", number_json(e.derivative)},
                                    {"elasticity", number_json(e.elasticity)}};
    result["indices"] = indices;
    result["blocks"] = blocks;
    if (!nested.empty())
      result["nested"] = nested;
  }

private:
  std::vector<OutputIndices> outputs_;
  std::vector<std::string> index_names_;
  std::vector<LocalElasticity> elasticities_;
};

// ---- page

std::string indices_html(const Json& result) {
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
    html += html_heading("Source", titles);
    for (const auto& [input, index] : inputs.items()) {
      std::vector<std::string> cells;
      for (const std::string& key : keys) {
        cells.push_back(html_text(index[key]));
        const bool known = index.contains("ci95") && index["ci95"].contains(key);
        cells.push_back(known ? html_interval(index["ci95"][key]) : "");
      }
      html += html_row(input, cells);
    }
    html += "</table>\n";
  }
  return html;
}

void add_index_figures(std::vector<Figure>& figures, const StudyFile& study, const StoredResults& r,
                       const Json& result) {
  const char* const parts[3][2] = {{"first", "total"}, {"mu_star", nullptr}, {"elasticity", nullptr}};
  const auto& kinds = parts[static_cast<std::size_t>(study.part<SensitivityPart>().sensitivity.method)];
  for (const TableColumn& column : r.output_columns) {
    const auto found = result["indices"].find(column.name);
    if (found == result["indices"].end() || found->empty() || figures.size() >= most_figures)
      continue;
    std::vector<std::string> names;
    std::vector<std::pair<std::string, std::vector<std::array<double, 3>>>> groups;
    for (const char* part : kinds) {
      if (!part)
        continue;
      names.clear();
      std::vector<std::array<double, 3>> values;
      for (const auto& [input, index] : found->items()) {
        names.push_back(input);
        const double v = number_or_nan(index[part]);
        const bool ends = index.contains("ci95") && index["ci95"].contains(part);
        values.push_back({v, ends ? number_or_nan(index["ci95"][part][0]) : v,
                          ends ? number_or_nan(index["ci95"][part][1]) : v});
      }
      groups.emplace_back(part, values);
    }
    figures.push_back(bars("indices-" + column.name, column.name, groups, names, "index"));
  }
}

class SensitivityKind : public RowKind {
public:
  std::string_view name() const override { return "sensitivity"; }
  std::string_view sentence() const override {
    return "which source of error makes which share of an output's spread";
  }
  std::unique_ptr<StudyPart> part() const override { return std::make_unique<SensitivityPart>(); }
  std::span<const StudyTable> tables() const override {
    static const std::array tables{
        source_table(),
        correlation_table(),
        table<&SensitivityPart::sensitivity>("sensitivity", "which method, and how many rows"),
    };
    return tables;
  }
  void check(StudyChecker& checker) const override {
    check_uncertain(checker);
    check_sensitivity(checker);
  }
  Json plan_inputs(const StudyFile& study) const override { return plan_sources(study); }
  std::string_view plan_points(const StudyFile&) const override {
    return "row k from (seed, k, source) alone";
  }

  Outcome<SampledStudy> make_rows(const StudyFile& study, const RunContext& context) const override {
    return make_sensitivity_rows(study, context);
  }
  std::unique_ptr<const RowAnswer> answer(const StudyFile& study, const SampledStudy& rows,
                                          const RowTable& table) const override {
    return std::make_unique<SensitivityAnswer>(study, rows, table);
  }

  std::string report_tables(const StudyFile&, const Json& result) const override {
    return result.contains("indices") ? indices_html(result) : "";
  }
  std::vector<Figure> report_figures(const StudyFile& study, const StoredResults& results,
                                     const Json& result) const override {
    std::vector<Figure> figures;
    if (result.contains("indices"))
      add_index_figures(figures, study, results, result);
    return figures;
  }
};

} // namespace

const RowKind& sensitivity_kind() {
  static const SensitivityKind kind;
  return kind;
}

} // namespace strainwave
