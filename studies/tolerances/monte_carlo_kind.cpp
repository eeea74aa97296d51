// The kind "monte_carlo": its keys, checks, statistics and page.

#include "strainwave/common/statistics/association.hpp"
#include "strainwave/common/statistics/stop_rule.hpp"
#include "strainwave/common/statistics/summary.hpp"
#include "strainwave/studies/file/key_rows.hpp"
#include "strainwave/studies/report/page.hpp"
#include "strainwave/studies/tables/answer_text.hpp"
#include "strainwave/studies/tolerances/monte_carlo.hpp"
#include "strainwave/studies/tolerances/outputs.hpp"

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

static constexpr Range open_unit{.lower = 0.0, .upper = 1.0, .lower_open = true, .upper_open = true};

static std::span<const std::string_view> names_of(SamplingDesign) {
  static constexpr std::array<std::string_view, 3> names{"random", "latin_hypercube", "sobol"};
  return names;
}

static StudyKeys study_keys(const StudySampling&) {
  static const std::array keys{
      choice_row<&StudySampling::design>("design", "how the samples are spread"),
      row<&StudySampling::samples>("samples", "", within(4, 2147483647.0), "samples in all"),
      row<&StudySampling::randomisations>("randomisations", "", within(16, 65536),
                                          "independent repetitions of latin_hypercube and sobol designs"),
      row<&StudySampling::positions>("positions", "", within(1, 100000),
                                     "positions of the wave generator; a sample is the worst of them"),
      row<&StudySampling::quantiles>("quantiles", "", open_unit, "probabilities of the quantiles asked for"),
      outputs_row<&StudySampling::outputs>(),
      inner_row<&StudySampling::stop>("stop", "{ output = \"…\", half_width = … }",
                                      "end by itself: design \"random\" only, no shards"),
  };
  return keys;
}

static StudyKeys study_keys(const StudyStop&) {
  static const std::array keys{
      row<&StudyStop::output>("output", "", any, "the output that is watched", needed),
      row<&StudyStop::quantile>("quantile", "", open_unit, "its quantile of this probability"),
      row<&StudyStop::limit>("limit", "", any,
                             "or the probability of exceeding this limit; neither: its mean"),
      row<&StudyStop::half_width>("half_width", "", above_zero(1e12),
                                  "half width of the 95 % interval at which the study ends", needed),
  };
  return keys;
}

static StudyKeys study_keys(const StudyExceedance&) {
  static const std::array keys{
      row<&StudyExceedance::output>("output", "", any,
                                    "the output whose probability of exceeding is asked for", needed),
      row<&StudyExceedance::limit>("limit", "", any, "the limit, in the unit of the output", needed),
  };
  return keys;
}

namespace {

// ---- checks

class MonteCarloCheck {
public:
  explicit MonteCarloCheck(StudyChecker& checker)
      : checker_(checker), part_(checker.study().part<MonteCarloPart>()) {}

  void run() {
    const StudySampling& s = part_.sampling;
    checker_.check_names("sampling.outputs", s.outputs, sampled_response_names(), sampled_counterparts());
    for (std::size_t i = 0; i < part_.exceedances.size(); ++i)
      check_recorded(fmt::format("exceedance[{}].output", i), part_.exceedances[i].output);
    const std::string key = checker_.given("sampling.samples") ? "sampling.samples" : "sampling";
    if (s.design != SamplingDesign::random) {
      const int each = s.samples / s.randomisations;
      if (s.samples % s.randomisations != 0 || each < 4)
        checker_.fault(key,
                       fmt::format("must be a multiple of randomisations = {}, and at least 4 each, is {}",
                                   s.randomisations, s.samples));
      else if (s.design == SamplingDesign::sobol && !std::has_single_bit(static_cast<unsigned>(each)))
        checker_.fault(
            key,
            fmt::format("a Sobol' design wants randomisations = {} times a power of two, is {} ({} each)",
                        s.randomisations, s.samples, each));
    }
    if (!s.stop)
      return;
    check_recorded("sampling.stop.output", s.stop->output);
    if (s.stop->quantile && s.stop->limit)
      checker_.fault("sampling.stop", "has both quantile and limit; a study stops by one of them");
    if (s.design != SamplingDesign::random)
      checker_.fault("sampling.stop",
                     "needs design = \"random\": the intervals of other designs need all their samples");
  }

private:
  /// An output that is asked about has to be recorded.
  void check_recorded(const std::string& key, const std::string& name) {
    checker_.check_name(key, name, sampled_response_names(), "output", sampled_counterparts());
    const auto& recorded = part_.sampling.outputs;
    if (!find_response(sampled_responses(), name))
      return; // said already
    if (checker_.given(key) && !recorded.empty() &&
        std::find(recorded.begin(), recorded.end(), name) == recorded.end())
      checker_.fault(key, fmt::format("{} is not among sampling.outputs", name));
  }

  StudyChecker& checker_;
  const MonteCarloPart& part_;
};

// ---- statistics

struct SourceCorrelation {
  std::string input;
  Estimate pearson, spearman; ///< intervals: as for independent samples
};

struct OutputSummary {
  std::string output, unit;
  std::optional<Summary> summary;
  std::vector<SourceCorrelation> correlations;
  std::string missing; ///< why there is no statistic: too few rows with a result
};

class MonteCarloStatistics {
public:
  MonteCarloStatistics(const MonteCarloPart& part, const SampledStudy& rows, const RowTable& table)
      : part_(part), rows_(rows), table_(table) {
    read_inputs();
  }

  void add(OutputSummary& s, std::uint32_t output) const {
    SummaryRequest request;
    request.quantiles = part_.sampling.quantiles;
    for (const StudyExceedance& e : part_.exceedances)
      if (e.output == s.output)
        request.limits.push_back(e.limit);
    const std::vector<double> values = table_.column(output);
    try {
      s.summary = part_.sampling.design == SamplingDesign::random ? summarise(values, request)
                                                                  : randomised(output, request);
    } catch (const std::invalid_argument&) {
      s.missing = fmt::format("{} rows with a result are too few for statistics", values.size());
      return;
    }
    const std::vector<double> ranks = ranks_of(values);
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      s.correlations.push_back({rows_.input_columns[i].name, pearson_correlation(inputs_[i], values),
                                spearman_of_ranks(ranks_[i], ranks)});
  }

private:
  /// Named inputs of the rows with a result, column by column.
  void read_inputs() {
    const std::size_t columns = rows_.input_columns.size();
    inputs_.resize(columns);
    std::vector<double> chunk;
    for (std::uint64_t first = 0; columns > 0 && first < table_.rows();) {
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(4096, table_.rows() - first));
      chunk.resize(count * columns);
      rows_.input_values(first, count, chunk);
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < columns; ++i)
          if (table_.status()[first + k] == row_ok)
            inputs_[i].push_back(chunk[k * columns + i]);
      first += count;
    }
    for (const auto& column : inputs_)
      ranks_.push_back(ranks_of(column));
  }

  Summary randomised(std::uint32_t output, const SummaryRequest& request) const {
    const auto parts = static_cast<std::uint64_t>(part_.sampling.randomisations);
    const std::uint64_t each = table_.rows() / parts;
    std::vector<std::vector<double>> values(parts);
    for (std::uint64_t row = 0; row < each * parts; ++row)
      if (table_.status()[row] == row_ok)
        values[row / each].push_back(table_.value(row, output));
    const std::vector<std::span<const double>> spans(values.begin(), values.end());
    return summarise_randomised(spans, request);
  }

  const MonteCarloPart& part_;
  const SampledStudy& rows_;
  const RowTable& table_;
  std::vector<std::vector<double>> inputs_, ranks_;
};

RowKind::EnoughRule stop_rule_of(const MonteCarloPart& part, const SampledStudy& rows) {
  if (!part.sampling.stop)
    return {};
  const StudyStop& stop = *part.sampling.stop;
  StopRule rule{.of = StopRule::Of::mean, .argument = 0.0, .half_width = stop.half_width};
  if (stop.quantile) {
    rule.of = StopRule::Of::quantile;
    rule.argument = *stop.quantile;
  } else if (stop.limit) {
    rule.of = StopRule::Of::exceedance;
    rule.argument = *stop.limit;
  }
  std::uint32_t output = 0;
  while (output < rows.output_columns.size() && rows.output_columns[output].name != stop.output)
    ++output;
  if (output == rows.output_columns.size())
    throw FieldError("sampling.stop.output", stop.output + " is not among the outputs of this study");
  return [rule, output](const RowTable& table, std::uint64_t count) {
    if (!looks_at(rule, count))
      return false;
    std::vector<double> values;
    for (std::uint64_t row = 0; row < count; ++row)
      if (table.status()[row] == row_ok)
        values.push_back(table.value(row, output));
    return reached(rule, values);
  };
}

Json summary_json(const OutputSummary& s) {
  const Summary& summary = *s.summary;
  Json json{{"samples", summary.samples},
            {"mean", number_json(summary.mean.value)},
            {"std", number_json(summary.std.value)}};
  Json quantiles = Json::object(), quantile_ends = Json::object();
  for (const QuantileEstimate& q : summary.quantiles) {
    quantiles[fmt::format("{}", q.probability)] = number_json(q.estimate.value);
    quantile_ends[fmt::format("{}", q.probability)] = interval_json(q.estimate.ci95);
  }
  json["quantiles"] = quantiles;
  json["exceeding"] = Json::array();
  for (const ExceedanceEstimate& e : summary.exceedances)
    json["exceeding"].push_back({{"limit", e.limit},
                                 {"probability", number_json(e.probability.value)},
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

void summary_table(const OutputSummary& s, std::back_insert_iterator<std::string> out) {
  const auto line = [&](const std::string& name, const Estimate& e) {
    fmt::format_to(out, "    {:<34} {:>12}   {}\n", name, number_in_words(e.value),
                   interval_in_words(e.ci95));
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

class MonteCarloAnswer : public RowAnswer {
public:
  MonteCarloAnswer(const MonteCarloPart& part, const SampledStudy& rows, const RowTable& table) {
    const MonteCarloStatistics statistics(part, rows, table);
    for (std::uint32_t output = 0; output < table.outputs(); ++output) {
      OutputSummary s{.output = rows.output_columns[output].name,
                      .unit = rows.output_columns[output].unit,
                      .summary = {},
                      .correlations = {},
                      .missing = {}};
      if (table.failed() == table.done())
        s.missing = "no row has a result";
      else
        statistics.add(s, output);
      outputs_.push_back(std::move(s));
    }
  }
  std::string text() const override {
    std::string text;
    const auto out = std::back_inserter(text);
    for (const OutputSummary& s : outputs_) {
      fmt::format_to(out, "  {} ({}){}\n", s.output, s.unit, s.missing.empty() ? "" : ": " + s.missing);
      if (s.summary)
        summary_table(s, out);
    }
    return text;
  }
  void add_json(Json& result) const override {
    Json statistics = Json::object();
    for (const OutputSummary& s : outputs_)
      statistics[s.output] = s.summary ? summary_json(s) : Json{{"missing", s.missing}};
    result["statistics"] = statistics;
  }

private:
  std::vector<OutputSummary> outputs_;
};

// ---- page

Figure histogram(const std::string& output, const std::string& unit, const Json& s) {
  Figure figure;
  figure.name = "histogram-" + output;
  const double lower = s["histogram"]["lower"], upper = s["histogram"]["upper"];
  const auto& counts = s["histogram"]["counts"];
  const double width = counts.empty() ? 1.0 : (upper - lower) / static_cast<double>(counts.size());
  figure.data = fmt::format("# middle of the bin ({}), samples\n", unit);
  double most = 1.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    most = std::max(most, counts[i].get<double>());
    figure.data +=
        fmt::format("{:.9g} {}\n", lower + (static_cast<double>(i) + 0.5) * width, counts[i].get<double>());
  }
  figure.drawing = fmt::format("set xlabel '{}' noenhanced\nset ylabel 'samples'\nset style fill solid 0.5 "
                               "noborder\nset yrange [0:{}]\n",
                               axis_label(output, unit), 1.15 * most);
  int k = 0;
  for (const auto& [p, value] : s["quantiles"].items())
    if (value.is_number())
      figure.drawing += fmt::format(
          "set arrow from {0:.9g},0 to {0:.9g},{1} nohead linecolor '{2}' dashtype 2\n"
          "set label '{3}' at {0:.9g},{4} offset 0.4,0 textcolor '{2}'\n",
          value.get<double>(), 1.05 * most, figure_colour(1), p, (1.05 + 0.04 * (k++ % 2)) * most);
  figure.drawing += fmt::format("plot '{}.dat' using 1:2:({:.9g}) with boxes linecolor '{}' notitle\n",
                                figure.name, width > 0.0 ? width : 1.0, figure_colour(0));
  return figure;
}

void add_monte_carlo(std::vector<Figure>& figures, const StoredResults& r, const Json& result) {
  for (const TableColumn& column : r.output_columns) {
    const auto found = result["statistics"].find(column.name);
    if (found == result["statistics"].end() || !found->contains("histogram") ||
        figures.size() >= most_figures)
      continue;
    figures.push_back(histogram(column.name, column.unit, *found));
    std::vector<std::string> names;
    std::vector<std::array<double, 3>> values;
    for (const auto& [input, c] : (*found)["correlation"].items()) {
      names.push_back(input);
      values.push_back({number_or_nan(c["pearson"]["value"]), number_or_nan(c["pearson"]["ci95"][0]),
                        number_or_nan(c["pearson"]["ci95"][1])});
    }
    if (!names.empty())
      figures.push_back(
          bars("correlation-" + column.name, column.name, {{"correlation", values}}, names, "correlation"));
  }
}

std::string statistics_html(const Json& result) {
  std::string html;
  for (const auto& [name, s] : result["statistics"].items()) {
    html += fmt::format("<h2>{}</h2>\n", escape_html(name));
    if (s.contains("missing")) {
      html += fmt::format("<p class=bad>{}</p>\n", html_text(s["missing"]));
      continue;
    }
    html += html_heading(fmt::format("{} samples", s["samples"].get<std::uint64_t>()), {"value", "95 %"});
    html += html_row("mean", {html_text(s["mean"]), html_interval(s["ci95"]["mean"])});
    html += html_row("standard deviation", {html_text(s["std"]), html_interval(s["ci95"]["std"])});
    for (const auto& [p, value] : s["quantiles"].items())
      html += html_row("quantile " + p, {html_text(value), html_interval(s["ci95"]["quantiles"][p])});
    for (const Json& e : s["exceeding"])
      html += html_row(fmt::format("probability above {}", e["limit"].get<double>()),
                       {html_text(e["probability"]), html_interval(e["ci95"])});
    for (const auto& [input, c] : s["correlation"].items())
      html += html_row("correlation with " + input,
                       {html_text(c["pearson"]["value"]), html_interval(c["pearson"]["ci95"])});
    html += "</table>\n";
  }
  return html;
}

class MonteCarloKind : public RowKind {
public:
  std::string_view name() const override { return "monte_carlo"; }
  std::string_view sentence() const override { return "samples of gears with errors, and their statistics"; }
  std::unique_ptr<StudyPart> part() const override { return std::make_unique<MonteCarloPart>(); }
  std::span<const StudyTable> tables() const override {
    static const std::array tables{
        source_table(),
        correlation_table(),
        table<&MonteCarloPart::sampling>("sampling", "how many samples, and what is asked of them"),
        table<&MonteCarloPart::exceedances>("exceedance",
                                            "a limit whose probability of being exceeded is asked for"),
    };
    return tables;
  }
  void check(StudyChecker& checker) const override {
    check_uncertain(checker);
    MonteCarloCheck(checker).run();
  }
  Json plan_inputs(const StudyFile& study) const override { return plan_sources(study); }
  std::string_view plan_points(const StudyFile&) const override {
    return "row k from (seed, k, source) alone";
  }

  Outcome<SampledStudy> make_rows(const StudyFile& study, const RunContext& context) const override {
    return make_monte_carlo_rows(study, context);
  }
  std::unique_ptr<const RowAnswer> answer(const StudyFile& study, const SampledStudy& rows,
                                          const RowTable& table) const override {
    return std::make_unique<MonteCarloAnswer>(study.part<MonteCarloPart>(), rows, table);
  }
  EnoughRule enough(const StudyFile& study, const SampledStudy& rows) const override {
    return stop_rule_of(study.part<MonteCarloPart>(), rows);
  }
  bool ends_by_itself(const StudyFile& study) const override {
    return study.part<MonteCarloPart>().sampling.stop.has_value();
  }

  std::string report_tables(const StudyFile&, const Json& result) const override {
    return result.contains("statistics") ? statistics_html(result) : "";
  }
  std::vector<Figure> report_figures(const StudyFile&, const StoredResults& results,
                                     const Json& result) const override {
    std::vector<Figure> figures;
    if (result.contains("statistics"))
      add_monte_carlo(figures, results, result);
    return figures;
  }
};

} // namespace

const RowKind& monte_carlo_kind() {
  static const MonteCarloKind kind;
  return kind;
}

} // namespace strainwave
